"""Least squares that outliers do not pull: Huber's weights, row by row, until nothing changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from identification.factors import added, factors
from identification.least_squares import Problem, Solution
from identification.observed import Observed
from identification.sampling import Rows

#: Standard deviations from which a residual counts less: 95 % efficient where the noise is Gaussian (Huber 1964).
_KNEE = 1.345
#: Median absolute deviation of unit Gaussian noise.
_MAD = 0.6745
_ITERATIONS = 30
#: Change, in standard deviations, that ends the iteration.
_SETTLED = 1e-3


@dataclass(frozen=True)
class Robust:
    """The problem with its rows weighted, its solution, and how many of the rows count less than fully.

    Weights are those of residuals with the parameters ``values``, in parts of each joint's ``scale`` [N m, N].
    """

    problem: Problem
    solution: Solution
    outliers: int
    values: Mapping[str, float]
    scale: Mapping[int, float]

    def rows(self, run: Observed) -> Iterator[Rows]:
        """The rows of a run times the roots of their weights."""
        return iter(_weighted(run, self.values, self.scale)[1])


def robust(problem: Problem, runs: Sequence[Observed]) -> Robust:
    """Iteratively reweighted least squares; a joint's scale is the median of its absolute residuals."""
    solution = problem.solve()
    outliers, at, scale = 0, solution.values, dict[int, float]()
    for _ in range(_ITERATIONS):
        at, scale = solution.values, _scales(runs, solution.values)
        weighted = [_weighted(run, at, scale) for run in runs]
        outliers = sum(count for count, _ in weighted)
        problem = replace(problem, factors=added([f for _, parts in weighted for f in factors(iter(parts))]))
        previous, solution = solution, problem.solve()
        steps = [
            abs(solution.values[n] - previous.values[n]) / max(solution.std(n), 1e-300)
            for n in problem.names
            if n not in solution.hidden
        ]
        if max(steps, default=0.0) < _SETTLED:
            break
    return Robust(problem, solution, outliers, at, scale)


def _scales(runs: Sequence[Observed], values: Mapping[str, float]) -> dict[int, float]:
    found: dict[int, list[float]] = {}
    for run in runs:
        for part in run.rows():
            found.setdefault(part.joint, []).extend(np.abs(part.errors(values)).tolist())
    return {joint: float(np.median(errors)) / _MAD + 1e-300 for joint, errors in found.items()}


def _weighted(run: Observed, values: Mapping[str, float], scale: Mapping[int, float]) -> tuple[int, list[Rows]]:
    """The rows times the roots of their weights, and how many weights are below 1."""
    outliers, parts = 0, []
    for part in run.rows():
        size = np.abs(part.errors(values)) / scale[part.joint]
        root = np.sqrt(np.minimum(1.0, _KNEE / np.maximum(size, 1e-300)))
        outliers += int((size > _KNEE).sum())
        parts.append(replace(part, W=part.W * root[:, None], Y=part.Y * root))
    return outliers, parts
