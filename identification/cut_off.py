"""Efforts that are cut off: a drive's limit or a converter's end stands in their place."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from generator.errors import InputError
from identification.arrays import Array
from identification.neighbours import at_extremes, in_a_row
from identification.recording import Where
from identification.signals import Measured

#: Part of a run that may be cut off.
_MOST = 0.2
#: How much longer than one step from its extreme a signal that is cut off stays there.
_LONGER = 3


@dataclass(frozen=True)
class Stretch:
    """Samples ``start`` to ``end`` (not included) of effort ``coordinate``."""

    coordinate: int
    start: int
    end: int


def stretches(effort: Measured, q: Array, where: Where, resting: bool = False) -> list[Stretch]:
    """Where an effort stays at its largest or smallest value while the joints, at ``q`` (n x N), move: it is cut off
    there.

    Raises InputError for an effort that is the same in all rows, and, unless the robot is ``resting``, for one that is
    cut off in more than a fifth.
    """
    result = []
    moves = np.concatenate([[False], np.any(np.diff(q, axis=-1) != 0, axis=0)])
    for k, (name, x) in enumerate(zip(effort.names, effort.values, strict=True)):
        if np.ptp(x) == 0:
            raise InputError(where(0, name), f"{name} is {x[0]:.6g} in all rows", "a measured signal")
        found = _cut_off(x, moves)
        if not resting and sum(one.stop - one.start for one in found) > _MOST * len(x):
            first = found[0].start
            problem = f"{name} stays at {x[first]:.6g} from here, as in more than a fifth of all rows"
            raise InputError(where(first, name), problem, "a signal that is not cut off")
        result += [Stretch(k, one.start, one.stop) for one in found]
    return result


def marks(found: Sequence[Stretch], shape: tuple[int, int]) -> NDArray[np.bool_] | None:
    """Samples (n x N) of the stretches; None without any."""
    if not found:
        return None
    result = np.zeros(shape, dtype=bool)
    for one in found:
        result[one.coordinate, one.start : one.end] = True
    return result


def told(found: Sequence[Stretch], effort: Measured, where: Where) -> Iterator[str]:
    """What is to be told of the stretches, a line for each effort."""
    for k, name in enumerate(effort.names):
        mine = [one for one in found if one.coordinate == k]
        if mine:
            rows = sum(one.end - one.start for one in mine)
            several = f" in {len(mine)} stretches, of which here is the first" if len(mine) > 1 else ""
            yield f"{where(mine[0].start, name)}: {name} is cut off for {rows} rows{several}, which are left out"


def _cut_off(x: Array, moves: NDArray[np.bool_]) -> list[slice]:
    """Where an effort is cut off: it stays at an extreme while joints move, and hardly one step from it.

    At a smooth extreme a signal in coarse steps stays at most 1 + sqrt(2) times as long at the last one as at the one
    before.
    """
    values = np.unique(x)
    ends = {values[0]: values[1], values[-1]: values[-2]}
    piled = {extreme for extreme, before in ends.items() if _piled(x, moves, extreme, before)}
    return [one for one in at_extremes(x) if x[one.start] in piled and moves[one].mean() > 0.5]


def _piled(x: Array, moves: NDArray[np.bool_], extreme: float, before: float) -> bool:
    """Whether an effort that gets to its extreme is far longer there than at the value before it."""
    there, near = (x == extreme) & moves, ((x == extreme) | (x == before)) & moves
    excursions = [there[one] for one in in_a_row(near)]
    last = sum(int(one.sum()) for one in excursions)
    both = sum(len(one) for one in excursions if one.any())
    return last > _LONGER * (both - last)
