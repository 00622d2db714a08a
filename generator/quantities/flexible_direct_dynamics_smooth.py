"""Direct dynamic model with elastic drive trains and a smooth stand-in for sign(speed), to be integrated."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.model import Model
from generator.symbolic.sliding import sliding, smooth, surfaces
from generator.symbolic.vectors import Array


def _build(model: Model) -> tuple[Array]:
    qdd = model.flexible.direct_dynamics(model.tau, model.signal("tau_ext", model.dof))
    speeds = surfaces(model.flexible)
    widths = model.signal("width", model.flexible_dof)
    return (sliding(model.program, qdd, speeds, smooth(model.program, speeds, widths)),)


QUANTITY = Quantity(
    name="flexible_direct_dynamics_smooth",
    summary="Accelerations of motors and elongations with x / sqrt(x^2 + width^2) for sign(x), to be integrated.",
    details="Report eq. 11 but for the friction near rest; every Iam must be positive and M(q_a) positive definite.",
    inputs=signals.together(
        signals.flexible_q, signals.flexible_qd, signals.tau, signals.tau_ext, signals.flexible_width
    ),
    outputs=signals.together(signals.flexible_qdd),
    build=_build,
    applies=lambda model: bool(model.elastic),
    solves=True,
)
