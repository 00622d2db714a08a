"""Inverse dynamic model with a payload and a wrench on the tool (report eq. 50, 73)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.model import Model
from generator.symbolic.newton_euler import Wrench
from generator.symbolic.vectors import Array


def tool_wrench(model: Model) -> Wrench:
    """The wrench of the robot on its environment, in the tool frame."""
    nodes = model.signal("wrench", 6)
    return Wrench(nodes[:3], nodes[3:])


def _build(model: Model) -> tuple[Array]:
    return (model.loaded.inverse_dynamics(tool_wrench(model)),)


QUANTITY = Quantity(
    name="inverse_dynamics_loaded",
    summary="Joint torques with a payload and a wrench on the tool: M qdd + H + J^T wrench.",
    details="Report eq. 50 (body n+1) and 73; the payload is a body fixed in the tool frame.",
    inputs=signals.together(signals.q, signals.qd, signals.qdd, signals.wrench, signals.payload),
    outputs=signals.together(signals.tau),
    build=_build,
)
