"""Motor currents from joint torques (report eq. 75)."""

import numpy as np

from generator.quantities import signals
from generator.quantities.drive_maps import apply, coupling, drive_map, inverse, torque_constants, transpose
from generator.symbolic.model import Model
from generator.symbolic.vectors import Array


def _currents(model: Model, tau: Array) -> Array:
    rotor = apply(model, transpose(inverse(coupling(model))), tau)
    return np.array([torque / kt for torque, kt in zip(rotor, torque_constants(model), strict=True)], dtype=object)


QUANTITY = drive_map(
    name="motor_current",
    summary="Motor currents from joint torques: I = diag(kt)^-1 N^-T tau.",
    details="Inverse of report eq. 75; the torque constants are parameters.",
    source=signals.tau,
    target=signals.motor_current,
    result=_currents,
    with_currents=True,
)
