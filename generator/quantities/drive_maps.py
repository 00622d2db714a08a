"""What the maps between motors and joints share: the matrix N in exact rationals (report eq. 14 to 18, 49)."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import sympy

from generator.quantities.quantity import Quantity
from generator.symbolic.effect_torques import WARMTH
from generator.symbolic.function import Signal
from generator.symbolic.model import Model
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, array

Rationals = list[list[Fraction]]


def coupling(model: Model) -> Rationals:
    """N: motor speeds = N joint speeds (report eq. 14, 15)."""
    assert model.robot.drives is not None
    return [list(row) for row in model.robot.drives.coupling]


def inverse(matrix: Rationals) -> Rationals:
    """The exact inverse."""
    rational = sympy.Matrix([[sympy.Rational(x.numerator, x.denominator) for x in row] for row in matrix]).inv()
    return [[Fraction(int(x.p), int(x.q)) for x in row] for row in rational.tolist()]


def transpose(matrix: Rationals) -> Rationals:
    """The transpose: that of N takes motor torques to joint torques (report eq. 17)."""
    return [list(column) for column in zip(*matrix, strict=True)]


def apply(model: Model, matrix: Rationals, vector: Array) -> Array:
    """The product of an exact matrix and a vector of nodes."""
    return array(model.program, matrix) @ vector


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
