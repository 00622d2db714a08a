"""The time column: even, increasing, without gaps but few lost samples; or one line that says where it is not."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from generator.errors import InputError
from generator.words import plural
from identification.arrays import Array
from identification.neighbours import off_cubics
from identification.recording import A_PART, Recording

#: Unevenness, in periods, that is taken as even; and that from which a sample is missing.
_EVEN, _GAP = 0.02, 0.5
#: By how much, in periods, a clock that jitters is early or late at most, and the part of the positions' roughness by
#: its times that is left without it.
_OFF, _SMOOTHER = 0.4, 0.8
#: Samples in a row that a spline stands for, and the part of a run that may be lost.
_IN_A_ROW, _LOST = 4, 0.1
#: Steps in a row of which this many are of several samples at another rate: single ones that are lost come as close by
#: chance hardly ever.
_WINDOW, _SEVERAL = 8, 7


@dataclass(frozen=True)
class Clock:
    """Times ``t`` [s] of the M rows of a recording, each the sample number ``sample`` of a run that begins at ``start``
    and has one every ``period`` [s].
    """

    start: float
    period: float
    t: Array
    sample: NDArray[np.int_]

    @property
    def rate(self) -> float:
        """Samples per second [Hz]."""
        return 1 / self.period

    @property
    def even(self) -> Array:
        """Times (N) [s] of the run's samples, none of them before the first row or after the last."""
        even = self.start + self.period * np.arange(self.sample[-1] + 1)
        return np.clip(even, self.t[0], self.t[-1])

    @property
    def uneven(self) -> bool:
        """Whether rows are not at the times of their samples."""
        return bool(np.max(np.abs(self.t - self.start - self.period * self.sample)) > _EVEN * self.period)

    @property
    def steady(self) -> Clock:
        """The clock of rows that were taken at even times, whatever ``t`` says."""
        return replace(self, t=np.asarray(self.start + self.period * self.sample))

    @property
    def lost(self) -> NDArray[np.bool_]:
        """Samples (N) of which there is no row."""
        result = np.ones(self.sample[-1] + 1, dtype=bool)
        result[self.sample] = False
        return result

    def may_lose(self, rows: NDArray[np.bool_]) -> bool:
        """Whether a run is read without some of its ``rows`` (M), at its ends as between others."""
        kept = np.concatenate([[-1], self.sample[~rows], [self.sample[-1] + 1]])
        return _few(np.diff(kept) - 1)


def clock(recording: Recording) -> Clock:
    """The clock of a recording's rows.

    Raises InputError for a missing column, times that do not increase, gaps of more than a few samples and a change of
    the rate.
    """
    if "t" not in recording.columns:
        raise InputError(
            recording.where(None, "t"), "there is no column t", f"times in s{recording.why_lacking(['t'])}"
        )
    t = recording.columns["t"]
    if len(t) < 3:
        raise InputError(recording.where(None, "t"), plural(len(t), "row"), "a run")
    steps = np.diff(t)
    bad = np.flatnonzero(~(steps > 0))
    if bad.size:
        k = int(bad[0])
        problem = f"time goes from {t[k]:.9g} s to {t[k + 1]:.9g} s"
        raise InputError(recording.where(k + 1, "t"), problem, f"times that increase; {A_PART}")
    usual = float(np.median(steps))
    early = float(np.median(steps[: max(2, len(steps) // 50)]))
    reference = early if abs(early / usual - 1) > _GAP else usual
    samples = _samples(steps, reference)
    sample = np.concatenate([[0], np.cumsum(samples)])
    gaps = np.flatnonzero(np.abs(steps - samples * reference) > _GAP * reference)
    if not gaps.size and np.any(samples > 1) and not _near(t, sample):
        gaps = np.flatnonzero(samples > 1)
    if gaps.size:
        if _near(t, np.arange(len(t))):
            start, period = _line(t, np.arange(len(t)))
            return Clock(start, period, t, np.arange(len(t)))
        k = int(gaps[0])
        problem = f"time steps by {steps[k]:.6g} s, at {t[k + 1]:.9g} s, where it stepped by {reference:.6g} s"
        raise InputError(recording.where(k + 1, "t"), problem, f"one rate without gaps; {A_PART}")
    return Clock(float(t[0]), float(t[-1] - t[0]) / int(sample[-1]), t, sample)


def _line(t: Array, sample: NDArray[np.int_]) -> tuple[float, float]:
    """Start and period of the even times that are nearest to those of samples."""
    period, start = np.polyfit(sample, t, 1)
    return float(start), float(period)


def _near(t: Array, sample: NDArray[np.int_]) -> bool:
    """Whether times are near even ones, and no step is so long that a sample may be missing."""
    start, period = _line(t, sample)
    off = np.abs(t - start - period * sample)
    longest = np.max(np.diff(t) - (np.diff(sample) - 1) * period)
    return bool(np.max(off) < _OFF * period and longest < (1 + 2 * _OFF) * period)


def jitters(ticks: Clock, x: Array) -> bool:
    """Whether signals (n x M) that are smooth are smoother without the unevenness of their rows' times: it is of
    the clock, not of the rows. A clock that drifts is uneven and as smooth.
    """
    if not ticks.uneven or len(ticks.t) < 5 or np.max(np.abs(ticks.t - ticks.steady.t)) > 2 * _OFF * ticks.period:
        return False
    return _rough(ticks.steady.t, x) < _SMOOTHER * _rough(ticks.t, x)


def _rough(t: Array, x: Array) -> float:
    """How far rows are from the cubics through the two before and the two after each, in parts of their spread."""
    off = np.mean(np.abs(off_cubics(x, t)), axis=1)
    return float(np.sum(off / np.maximum(np.ptp(x, axis=1), 1e-12)))


def _samples(steps: Array, usual: float) -> NDArray[np.int_]:
    """How many samples each step is: more than one where a few are lost, in a recording that lost few."""
    samples: NDArray[np.int_] = np.rint(steps / usual).astype(int)
    lost = np.maximum(samples - 1, 0)
    return np.maximum(samples, 1) if _few(lost) else np.ones_like(samples)


def _few(lost: NDArray[np.int_]) -> bool:
    """Whether those ``lost`` in each step are so few, of the run and in a row, that a spline stands for them; many
    steps with lost ones are of another rate.
    """
    slower = np.convolve(lost > 0, np.ones(_WINDOW)).max() >= _SEVERAL
    return bool(lost.max() <= _IN_A_ROW and lost.sum() <= _LOST * len(lost) and not slower)
