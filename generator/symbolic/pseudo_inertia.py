"""A body's ten inertial parameters as one 4 x 4 matrix, the second moment of its mass in homogeneous coordinates.

P = integral of r r^T dm with r = (x, y, z, 1): [[tr(I)/2 1 - I, h], [h^T, m]] for the inertia tensor I, the first
moment h and the mass m about the frame's origin. Matter can have the ten parameters if and only if P is positive
semidefinite; P is definite unless the mass lies in a plane (Wensing, Kim and Slotine 2018, IEEE RA-L 3(1), 60-67).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from generator.robot.parameters import INERTIAL_STEMS

Matrix = NDArray[np.float64]

#: Part of a body's second moment by which rounded parameters may be beyond those of matter.
_ROUNDED = 1e-3


def pseudo_inertia(parameters: ArrayLike) -> Matrix:
    """P (4 x 4) of XX XY XZ YY YZ ZZ MX MY MZ M [kg m2, kg m, kg], XY = minus the integral of x y dm."""
    xx, xy, xz, yy, yz, zz, mx, my, mz, m = np.asarray(parameters, dtype=float)
    half = (xx + yy + zz) / 2
    return np.array([[half - xx, -xy, -xz, mx], [-xy, half - yy, -yz, my], [-xz, -yz, half - zz, mz], [mx, my, mz, m]])


def basis() -> Matrix:
    """P per unit of each of the ten parameters (10 x 4 x 4): P is linear in them."""
    return np.array([pseudo_inertia(unit) for unit in np.eye(len(INERTIAL_STEMS))])


def of_body(name: int | str, values: Mapping[str, float]) -> Matrix:
    """P of the body whose parameters are called XX<name> ... M<name>: a link's number, a payload's letters."""
    return pseudo_inertia([values[f"{stem}{name}"] for stem in INERTIAL_STEMS])


def possible(P: Matrix) -> bool:
    """Whether a body of some mass can have P, but for rounding; what has no mass is not judged."""
    if P[3, 3] <= 0:
        return True
    centre = P[:3, 3] / P[3, 3]
    about_centre = np.linalg.eigvalsh(P[:3, :3] / P[3, 3] - np.outer(centre, centre))
    return bool(about_centre[0] >= -_ROUNDED * np.trace(np.abs(P[:3, :3])) / P[3, 3])


def uniform_bar(mass: float, start: Sequence[float], end: Sequence[float], radius: float) -> Matrix:
    """P of a bar [kg] with its mass spread evenly from ``start`` to ``end`` [m].

    About the line the mass has the second moment of a ball of ``radius`` [m] in every direction: mass radius^2 / 5.
    """
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    centre, along = (a + b) / 2, b - a
    spread = np.outer(centre, centre) + np.outer(along, along) / 12 + np.eye(3) * radius**2 / 5
    return mass * np.block([[spread, centre[:, None]], [centre[None, :], np.ones((1, 1))]])
