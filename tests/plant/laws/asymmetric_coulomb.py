"""Coulomb friction in the positive direction only, by a bristle; half of it looks like an offset."""

from __future__ import annotations

from tests.plant.law import Law, stiff_way

LAW = Law(
    about="Coulomb friction, one direction stronger",
    unit="N m",
    typical=lambda robot, j: 0.3 * robot.chain[j].coulomb,
    values={"distance": stiff_way},
    torque="""
const double z = bristle(s, v, distance, 1.0, h);
return z > 0.0 ? size * z : 0.0;
    """,
    friction=True,
)
