"""Joint torques from rotor torques (report eq. 17)."""

from generator.quantities import signals
from generator.quantities.drive_maps import apply, coupling, drive_map, transpose

QUANTITY = drive_map(
    name="joint_torque",
    summary="Joint torques from rotor torques: tau = N^T tau_r.",
    details="Report eq. 17.",
    source=signals.motor_torque,
    target=signals.tau,
    result=lambda model, tau_r: apply(model, transpose(coupling(model)), tau_r),
)
