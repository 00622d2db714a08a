"""A body's ten inertial parameters as its pseudo-inertia, the second moment of its mass in homogeneous coordinates."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal

from generator.reference.arithmetic import Array, decimals

#: The ten inertial parameters of a body in the order of report eq. 4.
INERTIAL = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")


def pseudo_inertia(parameters: Mapping[str, Decimal]) -> Array:
    """Sigma = integral of p p^T dm with p = (x, y, z, 1) in the body's frame (4 x 4), [kg m2], [kg m], [kg].

    The inertia tensor J = (tr Sigma3) I - Sigma3 has the entries XX ... ZZ, so that XY = -integral of x y dm.
    """
    xx, xy, xz, yy, yz, zz, mx, my, mz, m = (parameters.get(name, Decimal(0)) for name in INERTIAL)
    half = (xx + yy + zz) / 2
    return decimals([[half - xx, -xy, -xz, mx], [-xy, half - yy, -yz, my], [-xz, -yz, half - zz, mz], [mx, my, mz, m]])


def of_body(number: int, values: Mapping[str, Decimal]) -> Array:
    """Pseudo-inertia of the body whose parameters are called ``XX<number>`` ... ``M<number>``; absent ones are zero."""
    return pseudo_inertia({name: values.get(f"{name}{number}", Decimal(0)) for name in INERTIAL})


def units() -> dict[str, Array]:
    """Pseudo-inertia per unit of each inertial parameter."""
    return {name: pseudo_inertia({name: Decimal(1)}) for name in INERTIAL}
