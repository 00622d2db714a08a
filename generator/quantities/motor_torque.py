"""Rotor torques from joint torques (report eq. 17)."""

from generator.quantities import signals
from generator.quantities.drive_maps import apply, coupling, drive_map, inverse, transpose

QUANTITY = drive_map(
    name="motor_torque",
    summary="Rotor torques from joint torques: tau_r = N^-T tau.",
    details="Inverse of report eq. 17.",
    source=signals.tau,
    target=signals.motor_torque,
    result=lambda model, tau: apply(model, transpose(inverse(coupling(model))), tau),
)
