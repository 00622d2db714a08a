"""Joint speeds from rotor speeds (report eq. 14)."""

from generator.quantities import signals
from generator.quantities.drive_maps import apply, coupling, drive_map, inverse

QUANTITY = drive_map(
    name="joint_speed",
    summary="Joint speeds from rotor speeds: qd = N^-1 qrd.",
    details="Report eq. 14, 15.",
    source=signals.motor_speed,
    target=signals.qd,
    result=lambda model, qrd: apply(model, inverse(coupling(model)), qrd),
)
