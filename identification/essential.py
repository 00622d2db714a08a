"""Essential parameters: those that the data sees well enough to be worth keeping (report eq. 47)."""

from __future__ import annotations

import numpy as np

from identification.least_squares import Problem, Solution

#: Ratio of the largest to the smallest relative standard deviation at which elimination stops; 10 to 50 are usual.
RATIO = 30.0


def essential(problem: Problem, ratio: float = RATIO) -> tuple[Problem, Solution]:
    """Takes away the parameter with the largest relative standard deviation until max/min < ``ratio``.

    Report eq. 47 prints the comparison the other way round; elimination lowers the ratio, and its tables end below it.
    Parameters that no row shows go first, one at a time, as each may make others visible.
    """
    solution = problem.solve()
    while len(problem.names) > 1:
        relative = np.array([solution.relative_std(name) for name in problem.names])
        worst = int(np.argmax(relative))
        if np.isfinite(relative[worst]) and relative[worst] < ratio * relative.min():
            break
        problem = problem.without(problem.names[worst])
        solution = problem.solve()
    return problem, solution
