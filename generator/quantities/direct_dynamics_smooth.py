"""Direct dynamic model with a smooth stand-in for sign(qd), to be integrated."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.model import Model
from generator.symbolic.sliding import sliding, smooth
from generator.symbolic.vectors import Array


def _build(model: Model) -> tuple[Array]:
    qdd = model.base.direct_dynamics(model.tau)
    widths = model.signal("width", model.dof)
    return (sliding(model.program, qdd, model.qd, smooth(model.program, model.qd, widths)),)


QUANTITY = Quantity(
    name="direct_dynamics_smooth",
    summary="Joint accelerations with qd / sqrt(qd^2 + width^2) for sign(qd), to be integrated.",
    details="Report eq. 6 but for the friction near rest; M(q) must be positive definite.",
    inputs=signals.together(signals.q, signals.qd, signals.tau, signals.width),
    outputs=signals.together(signals.qdd),
    build=_build,
    solves=True,
)
