"""Inertia matrix (report eq. 2)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.function import Signal
from generator.symbolic.model import Model


def _matrix(model: Model) -> tuple[Signal]:
    return (signals.matrix("M", model.dof, model.dof, "inertia matrix, symmetric, rotor inertias included"),)


QUANTITY = Quantity(
    name="inertia_matrix",
    summary="Inertia matrix M(q), rotor inertias included.",
    details="Report eq. 2; entry (i, j) in the unit of torque i per acceleration j.",
    inputs=signals.together(signals.q),
    outputs=_matrix,
    build=lambda model: (model.base.inertia_matrix,),
)
