"""How the batch functions lay out the observation matrix of many samples."""

from __future__ import annotations

from dataclasses import dataclass

from generator.backends.printing.language import LINE
from generator.backends.printing.signals import listed
from generator.symbolic.function import Sparsity

#: Kept samples of a block of rows, and the most numbers that a line of the cache holds.
_BLOCK, _LINE = 128, 16


@dataclass(frozen=True)
class Layout:
    """Where the structural nonzeros of the regressor stand.

    An entry is a nonzero of joint j or, after the last one of each joint, that joint's torque. ``start`` is the first
    entry of each joint and behind them the number of entries; ``columns`` are lines of the columns of all entries, in
    order, and the width of the matrix for each torque; ``places`` the entries of the nonzeros, row by row;
    ``block`` the kept samples of a block of rows.
    """

    joints: int
    width: int
    start: tuple[int, ...]
    columns: tuple[str, ...]
    places: tuple[int, ...]
    block: int = _BLOCK

    @property
    def work(self) -> int:
        """Numbers of the work area: a block of kept samples of every entry, and room to align it."""
        return self.start[-1] * (self.block + _LINE) + _LINE


def layout(sparsity: Sparsity) -> Layout:
    """The entries of a regressor of this structure."""
    joints, width = sparsity.shape
    counts = [sparsity.rows.count(joint) for joint in range(joints)]
    start = tuple(sum(counts[:joint]) + joint for joint in range(joints + 1))
    places = tuple(place + row for place, row in enumerate(sparsity.rows))
    columns = dict.fromkeys(range(start[-1]), width) | dict(zip(places, sparsity.columns, strict=True))
    return Layout(joints, width, start, tuple(listed(map(str, columns.values()), LINE - 4)), places)
