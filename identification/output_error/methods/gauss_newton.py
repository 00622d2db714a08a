"""Gauss-Newton with sensitivities (report eq. 64-66), damped where a step makes the criterion worse.

The damping is Marquardt's (SIAM Journal on Applied Mathematics 11, 1963); M(q) stays positive definite by cutting
planes.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import numpy as np

from identification.arrays import Array
from identification.output_error.criterion import Criterion, Point
from identification.output_error.positivity import constrained
from identification.output_error.search import Minimum, Search

SUMMARY = "Gauss-Newton with sensitivities"

#: Iterations of a minimisation, and how often joints are weighted by the errors found.
_MOST, _WEIGHTINGS = 40, 2
#: Part of the criterion below which a step no longer improves it.
_ENOUGH = 1e-5
_FIRST, _SMALLEST, _LARGEST, _EASIER, _HARDER = 1e-6, 1e-11, 1e6, 0.1, 8.0


def minimise(search: Search, start: Array) -> Minimum:
    """The minimum from ``start`` (b) on, first states sought as well; joints weighted by their errors if asked for."""
    descent = _Descent(search)
    criterion, point = search.criterion, search.criterion.begin(start)
    for _ in range(_WEIGHTINGS if search.weighted else 1):
        if search.weighted:
            criterion = criterion.weighted(criterion.errors(point))
        point = descent.down(criterion, point)
    return Minimum(point, criterion, descent.simulations, descent.iterations, descent.settled)


@dataclass
class _Descent:
    """Counts what a descent takes, and tells whether the last one ended where no step gains."""

    search: Search
    simulations: int = 0
    iterations: int = 0
    settled: bool = False

    def __post_init__(self) -> None:
        settings = self.search.settings
        self._most = settings.iterations or _MOST * _WEIGHTINGS
        self._end = time.monotonic() + (settings.seconds or np.inf)

    def down(self, criterion: Criterion, point: Point) -> Point:
        """The minimum of one criterion."""
        value, damping = self._value(criterion, point), _FIRST
        self.settled = False
        for _ in range(_MOST):
            if self.iterations >= self._most or time.monotonic() > self._end or not np.isfinite(value):
                break
            self.iterations += 1
            normal = criterion.normal(criterion.linearised(point))
            if not normal.finite:
                break
            gain = 0.0
            while damping < _LARGEST:
                reduced = normal.reduced(damping)
                size = np.sqrt(np.diag(reduced.H))
                size = np.where(size > 0, size, 1.0)
                H = reduced.H / np.outer(size, size) + damping * np.eye(len(size))
                step = constrained(H, reduced.g / size, size, self.search.positivity, point.chi)
                states = tuple(old + new for old, new in zip(point.states, reduced.follow(step), strict=True))
                trial = replace(point, chi=point.chi + step, states=states)
                better = self._value(criterion, trial)
                if better < value:
                    gain, point, value = value - better, trial, better
                    damping = max(damping * _EASIER, _SMALLEST)
                    break
                damping *= _HARDER
            if gain <= _ENOUGH * value:
                self.settled = True
                break
        return point

    def _value(self, criterion: Criterion, point: Point) -> float:
        self.simulations += 1
        return criterion.value(point)
