"""Direct dynamic model for given directions of sliding."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.model import Model
from generator.symbolic.sliding import sliding
from generator.symbolic.vectors import Array


def _build(model: Model) -> tuple[Array]:
    qdd = model.base.direct_dynamics(model.tau)
    return (sliding(model.program, qdd, model.qd, model.signal("direction", model.dof)),)


QUANTITY = Quantity(
    name="direct_dynamics_sliding",
    summary="Joint accelerations with directions of sliding given instead of sign(qd).",
    details="Report eq. 6; -1 and 1 slide. What holds a joint at rest lies between.",
    inputs=signals.together(signals.q, signals.qd, signals.tau, signals.direction),
    outputs=signals.together(signals.qdd),
    build=_build,
    solves=True,
)
