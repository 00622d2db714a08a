"""Directions of columns in which noise of the positions is small: what it makes along others cannot be told."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.normal_equations import Places

#: Power along a direction, beside all that the rows hold there, from which it is of the positions' noise alone.
_DROWNED = 1.0


def clear(along: Array, noise: Iterable[tuple[Places, Array]]) -> Array:
    """Those of the directions ``along`` (k x m), of unit length over the rows, that are no noise of the positions, of
    which ``noise`` holds columns' numbers and rows (columns x N).
    """
    power = np.zeros(along.shape[1])
    for columns, rows in noise:
        power += np.sum((along[columns].T @ rows) ** 2, axis=1)
    return np.asarray(along[:, power <= _DROWNED])
