"""Direct dynamic model with elastic drive trains for given directions of sliding."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.model import Model
from generator.symbolic.sliding import sliding, surfaces
from generator.symbolic.vectors import Array


def _build(model: Model) -> tuple[Array]:
    qdd = model.flexible.direct_dynamics(model.tau, model.signal("tau_ext", model.dof))
    return (sliding(model.program, qdd, surfaces(model.flexible), model.signal("direction", model.flexible_dof)),)


QUANTITY = Quantity(
    name="flexible_direct_dynamics_sliding",
    summary="Accelerations of motors and elongations with directions of sliding given instead of sign(speed).",
    details="Report eq. 11; -1 and 1 slide. What holds a motor or a link at rest lies between.",
    inputs=signals.together(
        signals.flexible_q, signals.flexible_qd, signals.tau, signals.tau_ext, signals.flexible_direction
    ),
    outputs=signals.together(signals.flexible_qdd),
    build=_build,
    applies=lambda model: bool(model.elastic),
    solves=True,
)
