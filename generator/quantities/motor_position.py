"""Rotor positions from joint positions (report eq. 14)."""

from generator.quantities import signals
from generator.quantities.drive_maps import apply, coupling, drive_map

QUANTITY = drive_map(
    name="motor_position",
    summary="Rotor positions from joint positions: qr = N q.",
    details="Report eq. 14, 15, integrated from qr = 0 at q = 0.",
    source=signals.q,
    target=signals.motor_position,
    result=lambda model, q: apply(model, coupling(model), q),
)
