"""Torques of the bodies' weight (report eq. 73, Q(q))."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.quantities.weight import caveat

QUANTITY = Quantity(
    name="gravity",
    summary="Joint torques that hold the bodies' weight at rest.",
    details="Q(q) of report eq. 73; balancers, springs and offsets are effects and are not in it. "
    "With them bias(q, 0) holds the robot at rest.",
    inputs=signals.together(signals.q),
    outputs=signals.together(signals.renamed(signals.tau, "Q", "gravity torques, on the joint side")),
    build=lambda model: (model.base.gravity,),
    caveat=caveat,
)
