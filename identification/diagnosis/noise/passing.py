"""What passes by: a torque that disturbs a stretch of a motion that repeats in one of its periods and in no other.

A brake that drags for some seconds, a hand on the robot. What differs between periods counts as noise; so would this.
Rows that are disturbed tell nothing of the robot, and count nowhere once they are known. A shorter event is told by
what it leaves (``verdict.lack_of_fit``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d, uniform_filter1d

from generator.robot.description import Robot
from identification.diagnosis.noise.measured import by_period
from identification.diagnosis.runs.prepared import Prepared, windowed
from identification.run_source import RunSource
from identification.sampling import Sampled

Array = NDArray[np.float64]

#: Periods that have a row of a phase, from which what they have in common is known without any one of them.
_PERIODS = 3
#: Time [s] over which power is taken, within which stretches are one, that one lasts at least, and from the first row
#: before which nothing is told: what fades from there on is no disturbance that comes and goes.
_WINDOW, _APART, _SHORTEST, _BEGINNING = 0.5, 1.0, 0.25, 1.0
#: By how much the power of a stretch is above the usual one, and above that of the same phase in other periods.
_FAR, _ALONE = 36.0, 4.0
#: Least part of all that differs between periods that disturbed stretches hold, and their most of the rows.
_MOST, _FEW = 0.5, 0.25


@dataclass(frozen=True)
class Passing:
    """That coordinate ``k`` is disturbed in a run of the file ``path`` from the time ``begins`` to ``ends`` [s]."""

    k: int
    path: Path
    begins: float
    ends: float

    @property
    def when(self) -> str:
        """When, in words."""
        return f"{self.begins:.3g} to {self.ends:.3g} s of {self.path.name}"

    def told(self, robot: Robot) -> str:
        """In a sentence."""
        return (
            f"from {self.when} the torque of joint {robot.numbers[self.k]} is disturbed, as in no other period of the "
            "motion: these rows are left out"
        )


def passing(runs: Sequence[Prepared], residuals: Sequence[Array]) -> tuple[Passing, ...]:
    """What passes by in those of ``runs`` that have periods enough, of which a model leaves ``residuals`` [N m, N] (n x
    rows each).
    """
    there = [(run, e) for run, e in zip(runs, residuals, strict=True) if run.times >= _PERIODS]
    if not there:
        return ()
    return tuple(one for k in range(len(there[0][1])) for one in _of_joint(there, k))


def without(sampled: Sampled, passed: Sequence[Passing]) -> Sampled:
    """A run without the samples of each joint that something disturbs, begins to or ends to."""
    left_out, path = sampled.left_out.copy(), RunSource.of(sampled.run.name).path
    for one in passed:
        if one.path == path:
            near = (sampled.times >= one.begins - _WINDOW) & (sampled.times <= one.ends + _WINDOW)
            left_out[one.k, near] = True
    return replace(sampled, left_out=left_out)


def undisturbed(run: Prepared, passed: Sequence[Passing]) -> Prepared:
    """A prepared run without them."""
    sampled = without(run.sampled, passed)
    disturbed = windowed((sampled.left_out & ~run.sampled.left_out).astype(float), sampled.filters.factor) > 0
    return replace(run, sampled=sampled, kept=run.kept & ~disturbed)


def _of_joint(runs: Sequence[tuple[Prepared, Array]], k: int) -> Iterator[Passing]:
    """In all runs together: what is usual in one is in all."""
    different = [_different(e[k], run, k) for run, e in runs]
    powers = [_power(d, run) for d, (run, _) in zip(different, runs, strict=True)]
    every = np.concatenate(powers)
    if not (known := np.isfinite(every)).any():
        return
    usual = float(np.median(every[known]))
    found = [_stretches(power, usual, run) for power, (run, _) in zip(powers, runs, strict=True)]
    inside = [d[one] for d, ones in zip(different, found, strict=True) for one in ones]
    if not inside:
        return
    whole, rows = np.concatenate(different), np.concatenate(inside)
    if np.isfinite(rows).sum() > _FEW * np.isfinite(whole).sum() or np.nansum(rows**2) < _MOST * np.nansum(whole**2):
        return
    for (run, _), ones in zip(runs, found, strict=True):
        for one in ones:
            path = RunSource.of(run.sampled.run.name).path
            yield Passing(k, path, float(run.t[one][0]), float(run.t[one][-1]))


def _different(e: Array, run: Prepared, k: int) -> Array:
    """What rows (N) of joint k have beside the median of all periods at their phase; NaN where that is not known."""
    rows, there = by_period(e, run.period), by_period(run.kept[k], run.period)
    result = np.full(rows.shape, np.nan)
    known = np.flatnonzero(there.sum(axis=0) >= _PERIODS)
    beside = np.where(there, rows, np.nan)[:, known]
    result[:, known] = beside - np.nanmedian(beside, axis=0) if len(known) else beside
    return np.asarray(result.ravel()[: len(e)])


def _power(different: Array, run: Prepared) -> Array:
    """Mean square (N) of the rows about each; NaN where the row itself is not known."""
    known = np.isfinite(different)
    width = max(round(_WINDOW * run.rate), 1)
    square, count = (uniform_filter1d(x, width, mode="constant") for x in (np.nan_to_num(different) ** 2, 1.0 * known))
    return np.where(known, square / np.maximum(count, 1 / width), np.nan)


def _stretches(power: Array, usual: float, run: Prepared) -> list[slice]:
    """Stretches of a run whose ``power`` (N) is far above the ``usual`` one, and above that of other periods then."""
    far = np.nan_to_num(power) > np.maximum(_FAR * usual, _ALONE * _elsewhere(power, run))
    places = np.flatnonzero(far)
    parts = np.split(places, np.flatnonzero(np.diff(places) > _APART * run.rate) + 1)
    first = np.argmax(np.isfinite(power)) + _BEGINNING * run.rate
    # A single moment fills one window.
    least = (_SHORTEST + _WINDOW) * run.rate
    return [slice(int(part[0]), int(part[-1]) + 1) for part in parts if len(part) >= least and part[0] > first]


def _elsewhere(power: Array, run: Prepared) -> Array:
    """The most (N) that a power about the same phase is in another period."""
    near = maximum_filter1d(np.nan_to_num(power), max(round(_WINDOW * run.rate), 1))
    by_phase = by_period(near, run.period)
    others = [np.delete(by_phase, p, axis=0).max(axis=0) for p in range(len(by_phase))]
    return np.concatenate(others)[: len(power)]
