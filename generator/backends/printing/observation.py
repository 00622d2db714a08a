"""How the batch functions lay out the observation matrix of many samples."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate, pairwise
from math import ceil

from generator.backends.printing.language import LINE
from generator.backends.printing.signals import listed
from generator.symbolic.function import Sparsity

#: Kept samples of a block of rows, and the most numbers that a line of the cache holds, and its bytes.
_BLOCK, _LINE, _LINE_BYTES = 64, 16, 64
#: Parts into which the samples are divided: as many threads are kept busy.
_PARTS = 16


@dataclass(frozen=True)
class Layout:
    """Where the structural nonzeros of the regressor stand.

    An entry is a nonzero of joint j or, after the last one of each joint, that joint's torque. ``start`` is the first
    entry of each joint and behind them the number of entries; ``columns`` are lines of the columns of all entries, in
    order, and the width of the matrix for each torque; ``places`` the entries of the nonzeros, row by row;
    ``block`` the kept samples of a block of rows, ``parts`` the parts of the samples.
    """

    joints: int
    width: int
    start: tuple[int, ...]
    columns: tuple[str, ...]
    places: tuple[int, ...]
    block: int = _BLOCK
    parts: int = _PARTS

    @property
    def squares(self) -> tuple[int, ...]:
        """Where the square matrix of each joint's entries begins, and behind them the number of all numbers."""
        sizes = [behind - first for first, behind in pairwise(self.start)]
        return tuple(accumulate((size**2 for size in sizes), initial=0))

    @property
    def part(self) -> int:
        """Numbers of a part of the work area, in whole lines: a block of kept samples of all entries, the squares."""
        size = self.start[-1] * (self.block + _LINE) + self.squares[-1]
        return -(-size // _LINE) * _LINE

    @property
    def stack(self) -> int:
        """KiB of a thread's stack, in double precision: two blocks of all entries, a tile of rows, and the rest."""
        pitch = 8 * self.block + _LINE_BYTES
        size = 2 * (self.start[-1] + 1) * pitch + (_LINE_BYTES + 16) * self.joints * self.width + 8192
        return 64 * ceil(size / 2**16)

    @property
    def work(self) -> int:
        """Numbers of the work area: its parts, and room to align them."""
        return self.parts * self.part + _LINE


def layout(sparsity: Sparsity) -> Layout:
    """The entries of a regressor of this structure."""
    joints, width = sparsity.shape
    counts = [sparsity.rows.count(joint) for joint in range(joints)]
    start = tuple(sum(counts[:joint]) + joint for joint in range(joints + 1))
    places = tuple(place + row for place, row in enumerate(sparsity.rows))
    columns = dict.fromkeys(range(start[-1]), width) | dict(zip(places, sparsity.columns, strict=True))
    return Layout(joints, width, start, tuple(listed(map(str, columns.values()), LINE - 4)), places)
