"""Direct dynamic model (report eq. 6)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity

QUANTITY = Quantity(
    name="direct_dynamics",
    summary="Joint accelerations from torques: M(q) qdd = tau - H(q, qd).",
    details="Report eq. 6; M is factored from the last joint to the first. M(q) must be positive definite.",
    inputs=signals.together(signals.q, signals.qd, signals.tau),
    outputs=signals.together(signals.qdd),
    build=lambda model: (model.base.direct_dynamics(model.tau),),
    solves=True,
)
