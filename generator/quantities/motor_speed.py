"""Rotor speeds from joint speeds (report eq. 14)."""

from generator.quantities import signals
from generator.quantities.drive_maps import apply, coupling, drive_map

QUANTITY = drive_map(
    name="motor_speed",
    summary="Rotor speeds from joint speeds: qrd = N qd.",
    details="Report eq. 14, 15.",
    source=signals.qd,
    target=signals.motor_speed,
    result=lambda model, qd: apply(model, coupling(model), qd),
)
