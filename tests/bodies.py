"""Bodies by hand, apart from the generator: ten inertial parameters about a frame's origin, and what they must be."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: The stems of a body's parameters, in the order in which they stand wherever they stand without names.
STEMS = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
#: Pinocchio's order of them; they are about the frame's origin there too.
PINOCCHIO = ("M", "MX", "MY", "MZ", "XX", "XY", "YY", "XZ", "YZ", "ZZ")


def ten_parameters(mass: float, centre: Array, inertia: Array) -> Array:
    """Those (10) of a ``mass`` [kg] by the place of its ``centre`` (3) [m] and its ``inertia`` (3 x 3) [kg m2] there,
    in a frame with the same directions.
    """
    about_origin = mass * (centre @ centre * np.eye(3) - np.outer(centre, centre)) + inertia
    return np.array([*about_origin[np.triu_indices(3)], *mass * centre, mass])


def pseudo_inertia(ten: Sequence[float]) -> Array:
    """4 x 4 pseudo-inertia (Wensing, Kim, Slotine 2018); a body is possible where it is positive definite."""
    xx, xy, xz, yy, yz, zz, mx, my, mz, m = ten
    J = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    result = np.empty((4, 4))
    result[:3, :3] = np.trace(J) / 2 * np.eye(3) - J
    result[:3, 3] = result[3, :3] = mx, my, mz
    result[3, 3] = m
    return result
