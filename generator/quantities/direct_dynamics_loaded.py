"""Direct dynamic model with a payload and a wrench on the tool."""

from generator.quantities import signals
from generator.quantities.inverse_dynamics_loaded import tool_wrench
from generator.quantities.quantity import Quantity

QUANTITY = Quantity(
    name="direct_dynamics_loaded",
    summary="Joint accelerations with a payload and a wrench: M qdd = tau - H - J^T wrench.",
    details="Report eq. 6, 50, 73; the payload is a body fixed in the tool frame.",
    inputs=signals.together(signals.q, signals.qd, signals.tau, signals.wrench, signals.payload),
    outputs=signals.together(signals.qdd),
    build=lambda model: (model.loaded.direct_dynamics(model.tau, tool_wrench(model)),),
    solves=True,
)
