"""Joint positions from rotor positions (report eq. 14)."""

from generator.quantities import signals
from generator.quantities.drive_maps import apply, coupling, drive_map, inverse

QUANTITY = drive_map(
    name="joint_position",
    summary="Joint positions from rotor positions: q = N^-1 qr.",
    details="Report eq. 14, 15, integrated from qr = 0 at q = 0.",
    source=signals.motor_position,
    target=signals.q,
    result=lambda model, qr: apply(model, inverse(coupling(model)), qr),
)
