"""Potential energy of the weight and of what effects store."""

import numpy as np

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.quantities.weight import caveat
from generator.symbolic.dynamics import Dynamics
from generator.symbolic.model import Model
from generator.symbolic.vectors import Array, zeros


def _build(model: Model) -> tuple[Array]:
    at_zero = Dynamics(model.chain_at(zeros(model.program, model.dof)), (), model.kept, model.qd, model.qdd)
    energy = model.base.height_energy - at_zero.height_energy + model.base.effect_energy
    return (np.array(energy, dtype=object),)


QUANTITY = Quantity(
    name="potential_energy",
    summary="Potential energy of the weight and of what effects store, zero at q = 0.",
    details="Its gradient is the gravity torque plus those of balancers, springs and ripple (report eq. 19 to 37).",
    inputs=signals.together(signals.q),
    outputs=lambda model: (signals.scalar("U", "J", "potential energy, zero at q = 0"),),
    build=_build,
    caveat=caveat,
)
