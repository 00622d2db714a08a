"""Rows that hold what earlier ones did: those that a log repeated, and efforts that it took more slowly."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from generator.errors import InputError
from generator.words import listed
from identification.arrays import Array
from identification.neighbours import in_a_row
from identification.recording import A_PART, Where
from identification.signals import Measured

#: Rows in a row in which nothing changes that a log repeated, by how much more than a usual stretch without a change,
#: and part of what the steps about them would have made of them by which a position jumps behind.
_FROZEN, _RARELY, _CAUGHT_UP = 5, 5, 0.5
#: Part of the lengths of time for which a signal that was logged more slowly keeps a value that are alike, part of the
#: usual one that they differ by, part of them that may be one sample, and changes from which that is told.
_EVEN, _ALIKE, _SHORTER, _CHANGES = 0.6, 0.2, 0.05, 20


def live(at: Measured, effort: Measured, where: Where) -> None:
    """Raises InputError where a log repeated a row while the robot moved: nothing changes in many rows, and positions
    then jump to where they would have been.
    """
    changes = np.any(np.diff(np.concatenate([at.values, effort.values])) != 0, axis=0)
    kept = _kept(changes)
    usual = float(np.median(kept)) if kept.size else np.inf
    for one in in_a_row(~changes):
        rows = one.stop - one.start
        if rows < max(_FROZEN, _RARELY * usual) or one.start == 0 or one.stop + 1 >= len(changes):
            continue
        steps = np.abs(np.diff(at.values[:, [one.start - 1, one.start, one.stop, one.stop + 1, one.stop + 2]]))
        before, _, jump, after = steps.T
        moving = np.minimum(before, after)
        if np.any((moving > 0) & (jump > _CAUGHT_UP * (rows + 1) * moving)):
            name = at.names[int(np.argmax(jump))]
            problem = f"nothing changes from here for {rows} rows, and {name} then jumps"
            raise InputError(where(one.start + 1, name), problem, f"each row of its own time; {A_PART}")


def slower(effort: Measured, where: Where) -> Iterator[str]:
    """What is to be told of efforts that were logged more slowly than positions."""
    repeats = {name: _repeats(values) for name, values in zip(effort.names, effort.values, strict=True)}
    for rows in sorted({count for count in repeats.values() if count > 1}):
        names = [name for name, count in repeats.items() if count == rows]
        keep = f"{names[0]} keeps" if len(names) == 1 else f"{listed(names)} keep"
        were = "it was" if len(names) == 1 else "they were"
        yield f"{where(None, names[0])}: {keep} each value for {rows} rows: {were} logged more slowly"


def _repeats(x: Array) -> int:
    """For how many rows an effort typically keeps its value: 1, or more where it was logged more slowly.

    One that takes coarse steps keeps its values for as long as they last.
    """
    kept = _kept(np.diff(x) != 0)
    if len(kept) < _CHANGES:
        return 1
    count = int(np.median(kept))
    alike = np.mean(np.abs(kept - count) <= max(1.0, _ALIKE * count))
    return count if np.quantile(kept, _SHORTER) > 1 and alike > _EVEN else 1


def _kept(changes: NDArray[np.bool_]) -> NDArray[np.int_]:
    """For how many rows each value is kept, the first and the last aside, by where rows differ from those before."""
    return np.diff(np.flatnonzero(changes))
