"""What rows show: how many sums of the parameters, and which parameters not by themselves."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array

#: Singular values of a matrix with columns of unit length below this part of the largest are zero.
RANK = 1e-8
#: Part of a parameter in a direction that no row shows, from which it is not identifiable.
_INVOLVED = 1e-4
#: Length of a column that shows nothing, in parts of the longest.
_SILENT = 1e-12


def nonzero(singular_values: Array, least: float = RANK) -> NDArray[np.bool_]:
    """Which ``singular_values`` (r), in any order, of a matrix with columns of unit length are not zero: larger than
    the part ``least`` of the largest.
    """
    result: NDArray[np.bool_] = singular_values > least * singular_values.max(initial=0.0)
    return result


def not_identifiable(unseen: Array) -> NDArray[np.bool_]:
    """Which parameters (p) are not identifiable, by the directions ``unseen`` (k x p, of unit length) that no row
    shows; none where there are none of these.
    """
    result: NDArray[np.bool_] = np.abs(unseen).max(axis=0, initial=0.0) > _INVOLVED
    return result


def silent(size: Array) -> NDArray[np.bool_]:
    """Which columns, by their lengths ``size`` (p), are zero but for rounding."""
    result: NDArray[np.bool_] = size <= _SILENT * size.max(initial=0.0)
    return result


def in_lengths(R: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Columns (r x p) in units of their lengths (p), and which of them are silent: these are zero, their unit one."""
    size = np.linalg.norm(R, axis=0)
    unexcited = silent(size)
    size = np.where(unexcited, 1.0, size)
    return np.where(unexcited, 0.0, R / size), size, unexcited
