"""H(q, qd): the torque without acceleration (report eq. 2)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity

QUANTITY = Quantity(
    name="bias",
    summary="H(q, qd): centrifugal, Coriolis and gravity torques and all effects but inertias.",
    details="Report eq. 2.",
    inputs=signals.together(signals.q, signals.qd),
    outputs=signals.together(signals.renamed(signals.tau, "H", "torques without acceleration, on the joint side")),
    build=lambda model: (model.base.bias,),
)
