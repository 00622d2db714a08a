"""Inverse dynamic model in standard parameters (report eq. 3, 4)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity

QUANTITY = Quantity(
    name="inverse_dynamics_standard",
    summary="Joint torques tau = M(q) qdd + H(q, qd) from standard parameters, all effects included.",
    details="Report eq. 2 to 5; the standard parameters are an input of each call.",
    inputs=signals.together(signals.q, signals.qd, signals.qdd, signals.standard_parameters),
    outputs=signals.together(signals.tau),
    build=lambda model: (model.standard.inverse_dynamics(),),
)
