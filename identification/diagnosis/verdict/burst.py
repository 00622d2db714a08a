"""What happens on a joint for a moment: where its residual is far above the noise, above itself a period away, and
above what it is where the joint moves as fast.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d
from scipy.stats import chi2

from identification.arrays import Array
from identification.diagnosis.runs.prepared import Prepared

#: Rows of a burst that is looked for.
_BURST = 10
#: By how much it must stand out of the rest of the residual, in parts of its mean power.
_OUTSTANDING = 12.0
#: By how much its power is above that of what may come late at the time.
_BEYOND = 4.0
#: Part of a speed from which rows are as fast, and how many times the rows of a burst there must be to be compared.
_FAST, _COMPARED = 0.8, 3
#: Chance of all rows together beyond which noise makes none.
_CHANCE = 1e-12
#: Time [s] within which bursts of a run are one.
_APART = 1.0


@dataclass(frozen=True)
class Burst:
    """The largest of ``count`` bursts on a joint in all runs: the ``run`` it is in, and the ``time`` of its largest row
    there [s].
    """

    run: str
    time: float
    count: int = 1

    @property
    def words(self) -> str:
        """How often, and when."""
        when = f"at {self.time:.2f} s of {Path(self.run).name}"
        return f"once, {when}" if self.count == 1 else f"at least {self.count} times, the largest {when}"


def burst(runs: Sequence[Prepared], residuals: Sequence[Array], k: int, late: Sequence[Array]) -> Burst | None:
    """Where the white residual of coordinate k is far above the noise, above what may be ``late`` then, above itself a
    period before or after, and above what it is in other rows as fast, for a short time; not where a joint is
    unsettled.
    """
    found: list[tuple[float, str, float]] = []
    rows = sum(map(len, residuals))
    for run, e, known in zip(runs, residuals, late, strict=True):
        if len(e) < 5 * _BURST:
            continue
        unsettled = run.unsettled[k][run.kept[k]]
        square, of_late = (np.where(unsettled, 0.0, x**2) for x in (e, known))
        power, least = (np.convolve(x, np.ones(_BURST), "valid") for x in (square, of_late))
        kept = np.flatnonzero(run.kept[k])
        place = kept[_BURST // 2 :][: len(power)]
        least = np.maximum(least, _a_period_away(power, place, run.period))
        power[power < _BEYOND * least] = 0.0
        far = np.flatnonzero(power >= _OUTSTANDING * _BURST * max(float(np.mean(e**2)), 1.0))
        if len(far):
            speed = np.abs(run.decimated(run.sampled.motion.qd[k])[kept])
            as_fast = _as_fast(np.where(unsettled, np.nan, e**2), speed, far)
            far = far[power[far] >= _OUTSTANDING * _BURST * as_fast]
        # The rows about a short burst hold the same power wherever it is in them.
        times = run.t[kept[np.array([i + np.argmax(square[i : i + _BURST]) for i in far], dtype=int)]]
        apart = max(_APART, _BURST / run.rate)
        for one in np.split(np.arange(len(far)), np.flatnonzero(np.diff(times) > apart) + 1):
            if len(one):
                largest = one[np.argmax(power[far[one]])]
                found.append((float(power[far[largest]]), run.sampled.run.name, float(times[largest])))
    sure = [one for one in found if chi2.logsf(one[0], _BURST) < np.log(_CHANCE / max(rows, 1))]
    if not sure:
        return None
    _, name, time = max(sure)
    return Burst(name, time, len(sure))


def _as_fast(square: Array, speed: Array, at: NDArray[np.int64]) -> Array:
    """Power where a joint moves as fast as in the rows from ``at`` on, but not in these or within a burst of them, by
    the median of the squares, which other events hardly move; zero where too few do. Noise may grow with the speed.
    """
    near = maximum_filter1d(speed, _BURST)[np.minimum(at + _BURST // 2, len(speed) - 1)]
    result = np.zeros(len(at))
    for i, (start, fast) in enumerate(zip(at.tolist(), near.tolist(), strict=True)):
        others = (speed >= _FAST * fast) & np.isfinite(square)
        others[max(start - _BURST, 0) : start + 2 * _BURST] = False
        if np.count_nonzero(others) >= _COMPARED * _BURST:
            result[i] = np.median(square[others]) / chi2.median(1)
    return result


def _a_period_away(power: Array, place: NDArray[np.int64], period: int) -> Array:
    """The most that powers in the rows ``place`` are, about a ``period`` [rows] before or after; zero without one."""
    if not period:
        return np.zeros_like(power)
    rows = np.zeros(place[-1] + 1 + 2 * period)
    rows[place + period] = power
    near = maximum_filter1d(rows, _BURST)
    return np.asarray(np.maximum(near[place], near[place + 2 * period]))
