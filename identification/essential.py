"""Essential parameters: those that the data sees well enough to be worth keeping (report eq. 47)."""

from __future__ import annotations

import numpy as np

from identification.least_squares import Problem, Solution

#: Ratio of the largest to the smallest relative standard deviation at which elimination stops; 10 to 50 are usual.
RATIO = 30.0
#: Part by which the residual may be larger than with all parameters; 2 % to 4 % count as negligible.
GROWTH = 0.04
#: Standard deviations from nothing beyond which a parameter stays for what it explains: positions that are rounded, and
#: friction of another law, make some of them as well.
_SURE = 5.0


def essential(problem: Problem, ratio: float = RATIO, growth: float = np.inf) -> tuple[Problem, Solution]:
    """Takes away the parameter with the largest relative standard deviation until max/min < ``ratio``.

    The report asks for an error that is negligible beside that of all parameters: what would make the residual, each
    joint's in units of its own standard deviation, grow by more than the part ``growth`` stays whatever the ratio. So
    clean data, where the best parameters are known to many digits, do not lose what they show well. Of few rows the
    residual grows by more for what is hardly told from nothing: that goes.

    Report eq. 47 prints the comparison the other way round; elimination lowers the ratio, and its tables end below it.
    Parameters that no row shows go first, one at a time, as each may make others visible.
    """
    solution = full = problem.solve()
    start = _misfit(problem, full, full)
    most = max((1 + growth) * start, float(np.hypot(start, _SURE)))
    while len(problem.names) > 1:
        relative = np.array([solution.relative_std(name) for name in problem.names])
        worst = int(np.argmax(relative))
        if np.isfinite(relative[worst]) and relative[worst] < ratio * relative.min():
            break
        fewer = problem.without(problem.names[worst])
        found = fewer.solve()
        if np.isfinite(relative[worst]) and _misfit(fewer, found, full) > most:
            break
        problem, solution = fewer, found
    return problem, solution


def _misfit(problem: Problem, solution: Solution, full: Solution) -> float:
    """Residual of a solution, each joint's in units of its standard deviation with all parameters."""
    each = [one.residual(solution.values) / full.sigma[one.joint] for one in problem.factors]
    return float(np.linalg.norm(each))
