"""The time column: even, increasing, without gaps; or one line that says where it is not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from generator.errors import InputError
from generator.review.words import plural
from identification.recording import Array, Recording

#: Unevenness, in periods, that is taken as even; and that from which a sample is missing.
_EVEN, _GAP = 0.02, 0.5


@dataclass(frozen=True)
class Clock:
    """Start and period [s] of a run; ``uneven`` times (N) [s] where its samples must be moved to even ones."""

    start: float
    period: float
    uneven: Array | None = None

    @property
    def rate(self) -> float:
        """Samples per second [Hz]."""
        return 1 / self.period


def clock(recording: Recording, first: int = 0) -> Clock:
    """The clock of the rows from ``first`` of a recording.

    Raises InputError for a missing column, times that do not increase, gaps and a change of the rate.
    """
    if "t" not in recording.columns:
        raise InputError(recording.where(None, "t"), "there is no column t", "times in s")
    t = recording.columns["t"]
    if len(t) < 3:
        raise InputError(recording.where(None, "t"), plural(len(t), "row"), "a run")
    steps = np.diff(t)
    bad = np.flatnonzero(~(steps > 0))
    if bad.size:
        k = int(bad[0])
        problem = f"time goes from {t[k]:.9g} s to {t[k + 1]:.9g} s"
        raise InputError(recording.where(first + k + 1, "t"), problem, "times that increase")
    usual = float(np.median(steps))
    early = float(np.median(steps[: max(2, len(steps) // 50)]))
    reference = early if abs(early / usual - 1) > _GAP else usual
    gaps = np.flatnonzero(np.abs(steps - reference) > _GAP * reference)
    if gaps.size:
        k = int(gaps[0])
        problem = f"time steps by {steps[k]:.6g} s to {t[k + 1]:.9g} s, where it stepped by {reference:.6g} s"
        raise InputError(
            recording.where(first + k + 1, "t"), problem, "one rate without gaps; FILE@FROM:TO takes a part"
        )
    period = float(t[-1] - t[0]) / (len(t) - 1)
    even = t[0] + period * np.arange(len(t))
    uneven = bool(np.max(np.abs(t - even)) > _EVEN * period)
    return Clock(float(t[0]), period, t if uneven else None)
