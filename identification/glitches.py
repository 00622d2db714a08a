"""Samples that stand out alone: what a bus or a converter made of a signal, not the robot."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from generator.words import listed, plural
from identification.arrays import Array
from identification.neighbours import ARITHMETIC, off_cubics
from identification.recording import Where
from identification.signals import Measured
from identification.timing import Clock

#: What one wrong sample makes of the distances of itself and of two neighbours each way from cubics through theirs.
_ALONE = np.array([1.0, -4.0, 6.0, -4.0, 1.0]) / 6
#: Time [s] for which a signal may be wrong, and wrong samples in a row at most: what lasts is the robot's own.
_TIME, _MOST = 0.008, 3
#: What wrong samples in a row make of the distances about them, one column each, and the inverse, by their number.
_IN_A_ROW = [
    (made, np.linalg.pinv(made))
    for count in range(1, _MOST + 1)
    for made in [np.stack([np.pad(_ALONE, (k, count - 1 - k)) for k in range(count)], axis=1)]
]
#: Part of a sample that times are rounded by.
_CLOSE = 0.01
#: Distances of usual samples, of those that are rarely as far off, and steps of a signal, that a wrong one is off.
_FAR, _RARELY, _STEPS = 30.0, 4.0, 3.0
#: By how much more than the signal itself changes there, and least part of the farthest of wrong samples in a row.
_BACK, _ALIKE = 3.0, 0.2
#: Part of the distances that wrong samples may leave unexplained, and part of all samples that may be wrong.
_LEFT, _RARE = 0.15, 0.01


def glitches(x: Array, period: float) -> NDArray[np.int_]:
    """Numbers of the samples (N), one every ``period`` [s], that are off from all their neighbours; none where many
    are.

    A jump is of all samples after it, and a peak of the signal is of its neighbours too. A signal that has one step
    alone may be of a coarse sensor.
    """
    if len(x) < 2 * len(_ALONE):
        return np.array([], dtype=int)
    off = off_cubics(np.pad(x, 2, mode="reflect", reflect_type="odd"))
    steps = np.abs(np.diff(x))
    step = np.min(steps, where=steps > ARITHMETIC * np.ptp(x), initial=np.inf)
    # One wrong sample makes five distances large.
    rarely = float(np.quantile(np.abs(off), 1 - (len(_ALONE) + 1) * _RARE))
    far = max(_FAR * float(np.median(np.abs(off))), _RARELY * rarely, _STEPS * float(step))
    most = min(max(int(_TIME / period + _CLOSE), 1), _MOST)
    found: list[int] = []
    for i in np.flatnonzero(np.abs(off) > far / 2):
        if not found or i > found[-1]:
            found += _wrong(x, off, int(i), far, most)
    return np.array(found if len(found) <= _RARE * len(x) else [], dtype=int)


def _wrong(x: Array, off: Array, first: int, far: float, most: int) -> list[int]:
    """The wrong samples, of which number ``first`` is the first one, that make the distances about it."""
    for count, (made, inverse) in enumerate(_IN_A_ROW[:most], start=1):
        window = off[first - 2 : first + count + 2]
        if first < 2 or len(window) < count + 4:
            return []
        by = inverse @ window
        size = np.abs(by)
        if size.min() <= far or abs(by.sum()) < size.sum():
            continue
        explained = np.linalg.norm(window - made @ by) < _LEFT * np.linalg.norm(window)
        if explained and size.min() > max(_BACK * _change(x, first, first + count), _ALIKE * float(size.max())):
            return list(range(first, first + count))
    return []


def _change(x: Array, start: int, end: int) -> float:
    """By how much the signal jumps and bends over samples ``start`` to ``end``."""
    before, after = x[start - 1] - x[start - 2], x[end + 1] - x[end]
    jump = x[end] - x[start - 1] - (end - start + 1) * (before + after) / 2
    return float(abs(jump) + abs(after - before))


def without(found: Measured, ticks: Clock, where: Where) -> tuple[Measured, list[str]]:
    """The columns with a cubic spline through all other rows in the place of glitches, and what is to be told."""
    values, wrong = [], dict[str, NDArray[np.int64]]()
    for name, x in zip(found.names, found.values, strict=True):
        at = glitches(x, ticks.period)
        values.append(_repaired(x, ticks.t, at) if at.size else x)
        if at.size:
            wrong[name] = at
    if not wrong:
        return found, []
    return replace(found, values=np.stack(values)), [_told(wrong, where)]


def _told(wrong: Mapping[str, NDArray[np.int64]], where: Where) -> str:
    """Of samples that were ``wrong`` by column, the first of the first with its place."""
    name, first = next(iter(wrong.items()))
    here = f"{where(int(first[0]), name)}: {name} is off from its neighbours"
    if not (more := sum(map(len, wrong.values())) - 1):
        return f"{here}; it was interpolated"
    further = [column for column, at in wrong.items() if column != name or len(at) > 1]
    of = "" if further == [name] else f" of {listed(further)}"
    return f"{here}, and {plural(more, 'further sample')}{of} too; they were interpolated"


def _repaired(x: Array, t: Array, wrong: NDArray[np.int_]) -> Array:
    """A signal that stays where it was stays there in between; none goes beyond its other values."""
    result, right = x.copy(), np.setdiff1d(np.arange(len(x)), wrong)
    after = np.searchsorted(right, wrong)
    before, behind = x[right[after - 1]], x[right[after]]
    smooth = np.clip(make_interp_spline(t[right], x[right])(t[wrong]), x[right].min(), x[right].max())
    result[wrong] = np.where(before == behind, before, smooth)
    return result
