"""Least squares that outliers do not pull: Huber's function of the residuals, until nothing changes.

Ordinary least squares of pseudo-values, the model's torques plus bounded residuals, has the estimate of Huber's
function as its fixed point. With bounded residuals divided by the part that is not at the bounds, a step is that of
Newton's method, and the covariance that least squares tells of pseudo-values is Huber's,
K^2 s^2 E[psi^2]/E[psi']^2 (W^T W)^-1 (Huber, Robust Statistics, 1981, section 7.6).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from identification.factors import added, factors
from identification.least_squares import Problem, Solution
from identification.observed import Observed
from identification.residuals import MEDIAN_SIZE
from identification.sampling import Rows

#: Standard deviations from which a residual counts less: 95 % efficient where the noise is Gaussian (Huber 1964).
_KNEE = 1.345
_ITERATIONS = 30
#: Change, in standard deviations, that ends the iteration.
_SETTLED = 1e-3


@dataclass(frozen=True)
class Bound:
    """Of one joint's residuals: where they end [N m, N], and the factor ``gain`` [1] on what is within."""

    end: float
    gain: float


@dataclass(frozen=True)
class Robust:
    """The problem of pseudo-values, its solution, and how many of the rows count less than fully.

    Pseudo-values are those of residuals with the parameters ``values``, within each joint's ``bounds``.
    """

    problem: Problem
    solution: Solution
    outliers: int
    values: Mapping[str, float]
    bounds: Mapping[int, Bound]

    def rows(self, run: Observed) -> Iterator[Rows]:
        """The rows of a run with pseudo-values."""
        return iter(_bounded(run, self.values, self.bounds)[1])


def robust(problem: Problem, runs: Sequence[Observed]) -> Robust:
    """Least squares of pseudo-values again and again; a joint's scale is the median of its absolute residuals."""
    solution = problem.solve()
    outliers, at, bounds = 0, solution.values, dict[int, Bound]()
    for _ in range(_ITERATIONS):
        at, bounds = solution.values, _bounds(runs, solution.values, problem.names)
        pseudo = [_bounded(run, at, bounds) for run in runs]
        outliers = sum(count for count, _ in pseudo)
        problem = replace(problem, factors=added([f for _, parts in pseudo for f in factors(iter(parts))]))
        previous, solution = solution, problem.solve()
        steps = [
            abs(solution.values[n] - previous.values[n]) / max(solution.std(n), 1e-300)
            for n in problem.names
            if n not in solution.hidden
        ]
        if max(steps, default=0.0) < _SETTLED:
            break
    return Robust(problem, solution, outliers, at, bounds)


def _bounds(runs: Sequence[Observed], values: Mapping[str, float], sought: Sequence[str]) -> dict[int, Bound]:
    """By joint. The gain has the correction for n rows and p parameters, K = 1 + p/n var(psi')/E[psi']^2."""
    found: dict[int, list[float]] = {}
    unknowns: dict[int, int] = {}
    for run in runs:
        for part in run.rows():
            found.setdefault(part.joint, []).extend(np.abs(part.errors(values)).tolist())
            unknowns[part.joint] = len(set(part.names) & set(sought))
    result = {}
    for joint, sizes in found.items():
        if not sizes:
            result[joint] = Bound(0.0, 1.0)
            continue
        end = _KNEE * (float(np.median(sizes)) / MEDIAN_SIZE + 1e-300)
        within = float(np.mean(np.array(sizes) <= end))
        result[joint] = Bound(end, (1 + unknowns[joint] / len(sizes) * (1 - within) / within) / within)
    return result


def _bounded(run: Observed, values: Mapping[str, float], bounds: Mapping[int, Bound]) -> tuple[int, list[Rows]]:
    """The rows with pseudo-values, and how many residuals are beyond their bounds."""
    outliers, parts = 0, []
    for part in run.rows():
        error, bound = part.errors(values), bounds[part.joint]
        outliers += int((np.abs(error) > bound.end).sum())
        parts.append(replace(part, Y=part.Y - error + bound.gain * np.clip(error, -bound.end, bound.end)))
    return outliers, parts
