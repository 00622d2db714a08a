"""Inverse dynamic model in base parameters (report eq. 2, 3)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity

QUANTITY = Quantity(
    name="inverse_dynamics",
    summary="Joint torques tau = M(q) qdd + H(q, qd), all effects included.",
    details="Report eq. 2, 3, 5, 31, 37; no wrench on the tool.",
    inputs=signals.together(signals.q, signals.qd, signals.qdd),
    outputs=signals.together(signals.tau),
    build=lambda model: (model.base.inverse_dynamics(),),
)
