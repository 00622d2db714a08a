"""Joints whose torque drifts: the means of a motion's periods differ by more than noise, which changes as fast, allows.

What differs between periods counts as noise, a slow drift of a torque's offset too. But the mean of a period of noise
is no larger than the means of its parts let expect; that of a drift is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import f

from identification.arrays import Array
from identification.diagnosis.runs.phases import by_period
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.lack_of_fit import CHANCE

#: Parts of a period whose means tell how slow noise is, and the least share of its rows in every period.
_PARTS, _SHARE = 4, 0.25
#: Size of a drift, in the rms of what else differs between periods, from which it is one.
_LARGE = 0.5


@dataclass
class _Means:
    """Sums of squares and degrees of freedom: of the means of periods and of their parts, times the rows of each; and
    of the rows about the means of periods.
    """

    slow: float = 0.0
    periods: int = 0
    quick: float = 0.0
    parts: int = 0
    rows: float = 0.0

    def add(self, e: Array, kept: NDArray[np.bool_], period: int) -> None:
        """The rows (N) of one run, of which those that are ``kept`` count."""
        whole, rows = by_period(kept, period), by_period(e, period)
        # A last period that is a part counts if more rows can be compared with it than without it.
        counts = [count for count in (len(e) // period, len(whole)) if count > 1]
        count = max(counts, key=lambda one: one * int(whole[:one].all(axis=0).sum()), default=0)
        by_phase, there = rows[:count], whole[:count].all(axis=0)
        if not count or there.mean() < _SHARE:
            return
        differing = by_phase[:, there] - by_phase[:, there].mean(axis=0)
        mean = differing.mean(axis=1)
        about = differing - mean[:, None]
        self.slow += float(mean @ mean) * differing.shape[1]
        self.periods += count - 1
        self.quick += sum(float(np.sum(part.mean(axis=1) ** 2)) * part.shape[1] for part in _parts(about))
        self.parts += (count - 1) * (_PARTS - 1)
        self.rows += float(np.sum(about**2))

    @property
    def size(self) -> float:
        """The rms of the periods' means in that of the rows about them."""
        return float(np.sqrt(self.slow / self.rows)) if self.rows else 0.0

    @property
    def p(self) -> float:
        """How likely noise makes the means of periods differ as much."""
        if not self.periods or not self.quick:
            return 1.0
        return float(f.sf(self.slow / self.periods / (self.quick / self.parts), self.periods, self.parts))


def _parts(x: Array) -> list[Array]:
    return np.array_split(x, _PARTS, axis=1)


def drifting(found: Search, weights: Mapping[int, float]) -> dict[int, float]:
    """By coordinate, how large the drift is that values of columns by number leave, in the rms of what else differs
    between periods.
    """
    result, bank = {}, found.bank
    for k in range(bank.dof):
        means = _Means()
        for r, run in enumerate(bank.runs):
            if run.period >= 2 * _PARTS:
                means.add(bank.residual(r, k, weights, white=False), run.kept[k], run.period)
        if means.p < CHANCE and means.size > _LARGE:
            result[k] = means.size
    return result
