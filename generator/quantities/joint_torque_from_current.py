"""Joint torques from motor currents (report eq. 16, 18, 49, 75)."""

import numpy as np

from generator.quantities import signals
from generator.quantities.drive_maps import apply, coupling, drive_map, torque_constants, transpose
from generator.symbolic.model import Model
from generator.symbolic.vectors import Array


def _torques(model: Model, current: Array) -> Array:
    rotor = np.array([kt * i for kt, i in zip(torque_constants(model), current, strict=True)], dtype=object)
    return apply(model, transpose(coupling(model)), rotor)


QUANTITY = drive_map(
    name="joint_torque_from_current",
    summary="Joint torques from motor currents: tau = N^T diag(kt) I.",
    details="Report eq. 16, 18, 49, 75; the torque constants are parameters.",
    source=signals.motor_current,
    target=signals.tau,
    result=_torques,
    with_currents=True,
)
