"""What passes by: a torque that disturbs a stretch of a motion that repeats in one of its periods and in no other.

A brake that drags for some seconds, a hand on the robot. What differs between periods counts as noise; so would this.
Rows that are disturbed tell nothing of the robot, and count nowhere once they are known. Of two periods that differ
the one is disturbed which the model explains far less. A shorter event is told by what it leaves
(``verdict.lack_of_fit``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from scipy.ndimage import maximum_filter1d, uniform_filter1d

from generator.robot.description import Robot
from identification.arrays import Array
from identification.diagnosis.noise import least_noise
from identification.diagnosis.runs.phases import by_period
from identification.diagnosis.runs.prepared import Prepared, windowed
from identification.run_source import RunSource
from identification.sampling import Sampled

#: Periods that have a row of a phase, from which what they have in common is known without any one of them; and those
#: that tell how much differs.
_PERIODS, _BOTH = 3, 2
#: Time [s] over which power is taken, within which stretches are one, that one lasts at least, and from the first row
#: before which nothing is told: what fades from there on is no disturbance that comes and goes.
_WINDOW, _APART, _SHORTEST, _BEGINNING = 0.5, 1.0, 0.25, 1.0
#: By how much the power of a stretch is above the usual one at least, and above that of its phase in other periods.
_FAR, _ALONE = 16.0, 4.0
#: How unlikely noise is as far: the power to which the ratio of the upper quartile of powers to their median is raised,
#: which is large where noise stays for as long as power is taken over.
_UNLIKELY = 5
#: Least part of all that differs between periods that disturbed stretches hold, and their most of the rows.
_MOST, _FEW = 0.25, 0.25


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
            f"from {self.when} the torque of joint {robot.numbers[self.k]} differs from that of all other periods of "
            "the motion, as of a disturbance: these rows are left out"
        )


def passing(runs: Sequence[Prepared], residuals: Sequence[Array]) -> tuple[Passing, ...]:
    """What passes by in those of ``runs`` that have periods enough, of which a model leaves ``residuals`` [N m, N] (n x
    rows each).
    """
    there = [(run, e) for run, e in zip(runs, residuals, strict=True) if run.period]
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
    compared = [_compared(e[k], run, k) for run, e in runs]
    every = np.concatenate([one.power for one in compared])
    if not (known := np.isfinite(every)).any():
        return
    # No simulation is so exact that nothing differs between its periods.
    least = max(float(least_noise.deviations(run)[k]) ** 2 for run, _ in runs)
    median, upper = np.maximum(np.quantile(every[known], [0.5, 0.75]), max(least, 1e-300)).tolist()
    far = median * max(_FAR, (upper / median) ** _UNLIKELY)
    found = [_stretches(one, far, run) for one, (run, _) in zip(compared, runs, strict=True)]
    inside = [one.rows[stretch] for one, ones in zip(compared, found, strict=True) for stretch in ones]
    if not inside:
        return
    whole, rows = np.concatenate([one.rows for one in compared]), np.concatenate(inside)
    if np.isfinite(rows).sum() > _FEW * np.isfinite(whole).sum() or np.nansum(rows**2) < _MOST * np.nansum(whole**2):
        return
    for (run, _), ones in zip(runs, found, strict=True):
        for one in ones:
            path = RunSource.of(run.sampled.run.name).path
            yield Passing(k, path, float(run.t[one][0]), float(run.t[one][-1]))


@dataclass(frozen=True)
class _Compared:
    """What ``rows`` (N) have beside other periods at their phase, its ``power`` (N) about each, NaN where that is not
    known; and ``elsewhere`` (N) the most of it, of two periods of all that the model leaves, in others at the phase.
    Row number ``begins`` is the first that counts.
    """

    rows: Array
    power: Array
    elsewhere: Array
    begins: int


def _compared(e: Array, run: Prepared, k: int) -> _Compared:
    """The residual e (N) of joint k beside the median of all periods, of two that beside which it is larger."""
    there = by_period(run.kept[k], run.period)
    own = np.where(there, by_period(e, run.period), np.nan)
    left = by_period(_power(np.where(run.kept[k], e, np.nan), run), run.period)
    several, both = (np.flatnonzero(one) for one in (there.sum(axis=0) >= _PERIODS, there.sum(axis=0) == _BOTH))
    rows = np.full(own.shape, np.nan)
    rows[:, several] = own[:, several]
    if len(several):
        rows[:, several] -= np.nanmedian(own[:, several], axis=0)
    *_, less, more = np.argsort(np.where(there, left, -1.0)[:, both], axis=0)
    rows[more, both] = own[more, both] - own[less, both]
    different = rows.ravel()[: len(e)]
    power = _power(different, run)
    others = by_period(power, run.period)
    others[:, both] = left[:, both]
    return _Compared(different, power, _elsewhere(others, run)[: len(e)], int(np.argmax(run.kept[k])))


def _power(different: Array, run: Prepared) -> Array:
    """Mean square (N) of the rows about each; NaN where the row itself is not known."""
    known = np.isfinite(different)
    width = max(round(_WINDOW * run.rate), 1)
    square, count = (uniform_filter1d(x, width, mode="constant") for x in (np.nan_to_num(different) ** 2, 1.0 * known))
    return np.where(known, square / np.maximum(count, 1 / width), np.nan)


def _stretches(one: _Compared, far: float, run: Prepared) -> list[slice]:
    """Stretches of a run whose power is ``far`` or more, and above that of other periods then."""
    places = np.flatnonzero(np.nan_to_num(one.power) > np.maximum(far, _ALONE * one.elsewhere))
    parts = np.split(places, np.flatnonzero(np.diff(places) > _APART * run.rate) + 1)
    first = one.begins + _BEGINNING * run.rate
    # A single moment fills one window. Rows between that do not count are of the same stretch.
    least = (_SHORTEST + _WINDOW) * run.rate
    there = [slice(int(part[0]), int(part[-1]) + 1) for part in parts if len(part)]
    return [one for one in there if one.stop - one.start >= least and one.start > first]


def _elsewhere(power: Array, run: Prepared) -> Array:
    """The most that a power by period and phase is about the same phase in another period (all periods' rows)."""
    near = maximum_filter1d(np.nan_to_num(power).ravel(), max(round(_WINDOW * run.rate), 1)).reshape(power.shape)
    others = [np.delete(near, p, axis=0).max(axis=0, initial=0.0) for p in range(len(near))]
    return np.concatenate(others)
