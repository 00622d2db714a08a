"""Direct dynamic model with elastic drive trains (report eq. 11)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity

QUANTITY = Quantity(
    name="flexible_direct_dynamics",
    summary="Accelerations of motors and elongations from motor torques.",
    details="Report eq. 11 in block form; every Iam must be positive and M(q_a) positive definite.",
    inputs=signals.together(signals.flexible_q, signals.flexible_qd, signals.tau),
    outputs=signals.together(signals.flexible_qdd),
    build=lambda model: (model.flexible.direct_dynamics(model.tau),),
    applies=lambda model: bool(model.elastic),
    solves=True,
)
