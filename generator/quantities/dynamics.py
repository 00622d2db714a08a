"""Torques, inertia matrix and gravity in one call, for controllers that need all three."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.quantities.weight import caveat

QUANTITY = Quantity(
    name="dynamics",
    summary="Joint torques, inertia matrix and gravity torques of one state, what they share computed once.",
    details="Report eq. 2, 73: outputs of inverse_dynamics, inertia_matrix and gravity.",
    inputs=signals.together(signals.q, signals.qd, signals.qdd),
    outputs=lambda model: (
        signals.tau(model),
        signals.matrix("M", model.dof, model.dof, "inertia matrix, symmetric, rotor inertias included"),
        signals.renamed(signals.tau, "Q", "gravity torques, on the joint side")(model),
    ),
    build=lambda model: (model.base.inverse_dynamics(), model.base.inertia_matrix, model.base.gravity_beside_inertia),
    caveat=caveat,
)
