"""Coulomb friction that varies along a turn of the joint, with a second harmonic: an eccentric bearing."""

from __future__ import annotations

from tests.plant.law import Law, stiff_way

LAW = Law(
    about="position-dependent friction",
    unit="N m",
    typical=lambda robot, j: 0.4 * robot.chain[j].coulomb,
    values={"phase": 0.7, "distance": stiff_way},
    torque="""
const double along = cos(q - phase) + 0.35 * cos(2.0 * q + 1.0);
return size * along * bristle(s, v, distance, 1.0, h);
    """,
    friction=True,
)
