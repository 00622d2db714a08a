"""Kinetic energy of bodies and rotors."""

import numpy as np

from generator.quantities import signals
from generator.quantities.quantity import Quantity

QUANTITY = Quantity(
    name="kinetic_energy",
    summary="Kinetic energy of the robot, rotor inertias included.",
    details="1/2 qd^T M(q) qd.",
    inputs=signals.together(signals.q, signals.qd),
    outputs=lambda model: (signals.scalar("T", "J", "kinetic energy"),),
    build=lambda model: (np.array(model.base.kinetic_energy, dtype=object),),
)
