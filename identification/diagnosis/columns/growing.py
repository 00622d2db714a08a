"""Rows and products of columns that more columns join, the torque's being the last: few of them copy what is there."""

from __future__ import annotations

import numpy as np

from identification.arrays import Array

#: Columns for which there is room once there was none.
_ROOM = 100


class Rows:
    """Rows of columns, that of the torque the last (k + 1 x N)."""

    def __init__(self, rows: Array) -> None:
        self._room, self._count = rows, len(rows)

    @property
    def array(self) -> Array:
        """All of them; what was asked for before more joined is not theirs any more."""
        return self._room[: self._count]

    def join(self, more: Array) -> None:
        """With the rows of ``more`` columns (m x N) before that of the torque."""
        old, self._count = self._count - 1, self._count + len(more)
        if self._count > len(self._room):
            room = np.empty((self._count + _ROOM, self._room.shape[1]))
            room[: old + 1] = self._room[: old + 1]
            self._room = room
        self._room[self._count - 1] = self._room[old]
        self._room[old : self._count - 1] = more


class Products:
    """Products of columns with each other, those with the torque the last (c + 1 square)."""

    def __init__(self, products: Array) -> None:
        self._room, self._count = products, len(products)

    @property
    def array(self) -> Array:
        """All of them; what was asked for before more joined is not theirs any more."""
        return self._room[: self._count, : self._count]

    def join(self, count: int) -> Array:
        """With as many columns more before the torque, of which the products are zero: all that there are now."""
        old, self._count = self._count - 1, self._count + count
        if self._count > len(self._room):
            room = np.zeros((self._count + _ROOM,) * 2)
            room[: old + 1, : old + 1] = self._room[: old + 1, : old + 1]
            self._room = room
        result, torque = self.array, self._room[old, : old + 1].copy()
        result[old:], result[:, old:] = 0.0, 0.0
        result[-1, :old] = result[:old, -1] = torque[:-1]
        result[-1, -1] = torque[-1]
        return result
