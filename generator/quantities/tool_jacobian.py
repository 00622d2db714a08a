"""Jacobian of the tool frame (report eq. 73)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.kinematics import jacobian

QUANTITY = Quantity(
    name="tool_jacobian",
    summary="Jacobian of the tool frame: velocity of its origin and angular velocity per joint speed, in world axes.",
    details="J(q) of report eq. 73, in world axes.",
    inputs=signals.together(signals.q),
    outputs=lambda model: (
        signals.matrix("J", 6, model.dof, "Jacobian in world axes: rows vx vy vz of the origin, then wx wy wz"),
    ),
    build=lambda model: (jacobian(model.chain, model.chain.tool),),
)
