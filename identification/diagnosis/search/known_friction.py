"""What another value of the file's own friction would explain: it is no effect that is missing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from generator.effects.library import effects_of
from generator.robot.description import Robot
from identification.arrays import Array
from identification.diagnosis.columns.normal_equations import Normal, Places, inverse

#: Part of a column's square beside which it is another one, or a sum of others.
_SAME = 1e-6


def friction(robot: Robot, base: Sequence[str]) -> Places:
    """Places among the ``base`` parameters of those that are coefficients of the file's friction."""
    names = {name for one in effects_of(robot) if one.effect.dissipates for name in one.names}
    return np.array([place for place, name in enumerate(base) if name in names], dtype=int)


def explained(normal: Normal, columns: Sequence[int], others: Sequence[int], places: Places) -> tuple[float, int]:
    """How many of the friction coefficients at ``places`` have a column that some ``columns`` add up to, as the two
    directions of an asymmetric friction do, and by how much other values of them lower the sum of squares beside the
    columns of ``others``.
    """
    along, same = _sums(normal, columns, places)
    along = along[:, same]
    part = normal.part(columns, others)
    products = along.T @ part[:-1, -1]
    return float(products @ inverse(along.T @ part[:-1, :-1] @ along) @ products), along.shape[1]


def alike(normal: Normal, columns: Sequence[int], places: Places) -> Places:
    """Those of the ``places`` whose column some ``columns`` add up to: friction of the same law, told another way."""
    return places[_sums(normal, columns, places)[1]]


def _sums(normal: Normal, columns: Sequence[int], places: Places) -> tuple[Array, NDArray[np.bool_]]:
    """What of each of some ``columns`` (k) makes most of those at ``places`` (k x m), and whether that is all (m)."""
    at, G = np.array(columns, dtype=int), normal.gram
    across, size = G[np.ix_(at, places)], np.diag(G)[places]
    along = inverse(G[np.ix_(at, at)]) @ across
    return along, (size > 0) & (size - np.sum(along * across, axis=0) < _SAME * size)
