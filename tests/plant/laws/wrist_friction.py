"""Friction of a wrist's rotor, which turns with a sum of joints: Coulomb and viscous, back on all of them."""

from __future__ import annotations

from tests.plant.law import Law, stiff_way

LAW = Law(
    about="friction of a coupled rotor",
    unit="N m",
    typical=lambda robot, j: 0.5 * robot.chain[j].coulomb,
    values={"speed": lambda robot, j: 0.8 * robot.chain[j].range[2], "distance": stiff_way},
    torque="return size * (bristle(s, v, distance, 1.0, h) + v / speed);",
    friction=True,
    of_rotor=True,
)
