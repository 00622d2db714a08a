"""What the maps between motors and joints share: the exact matrix N (report eq. 14 to 18, 49)."""

from __future__ import annotations

from collections.abc import Callable

import sympy

from generator.constants import exact_constant
from generator.quantities.quantity import Quantity
from generator.symbolic.effect_torques import WARMTH
from generator.symbolic.function import Signal
from generator.symbolic.model import Model
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, array

Exact = list[list[sympy.Expr]]


def coupling(model: Model) -> Exact:
    """N: motor speeds = N joint speeds (report eq. 14, 15)."""
    assert model.robot.drives is not None
    return [list(row) for row in model.robot.drives.coupling]


def inverse(matrix: Exact) -> Exact:
    """The exact inverse."""
    inverted: Exact = sympy.Matrix(matrix).inv().expand().tolist()
    return inverted


def transpose(matrix: Exact) -> Exact:
    """The transpose: that of N takes motor torques to joint torques (report eq. 17)."""
    return [list(column) for column in zip(*matrix, strict=True)]


def apply(model: Model, matrix: Exact, vector: Array) -> Array:
    """The product of an exact matrix and a vector of nodes."""
    return array(model.program, [[exact_constant(entry) for entry in row] for row in matrix]) @ vector


def torque_constants(model: Model) -> list[Node]:
    """kt of each motor [N m/A], parameters of the model, times 1 + drift warmth where the file gives a drift."""
    constants = [model.parameter_nodes[parameter.name] for parameter in model.torque_constants]
    drift = model.robot.drives.torque_drift if model.robot.drives else ()
    if not drift:
        return constants
    warmth = model.signal(WARMTH, model.dof)
    return [kt * (1 + d * w) for kt, d, w in zip(constants, drift, warmth, strict=True)]


def drive_map(
    name: str,
    summary: str,
    details: str,
    source: Callable[[Model], Signal],
    target: Callable[[Model], Signal],
    result: Callable[[Model, Array], Array],
    with_currents: bool = False,
) -> Quantity:
    """A linear map from one signal of the drives to another."""

    def applies(model: Model) -> bool:
        return model.robot.drives is not None and (bool(model.torque_constants) or not with_currents)

    def build(model: Model) -> tuple[Array]:
        signal = source(model)
        return (result(model, model.signal(signal.name, signal.size)),)

    return Quantity(
        name, summary, details, lambda model: (source(model),), lambda model: (target(model),), build, applies
    )
