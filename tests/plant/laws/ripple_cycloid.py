"""Ripple of a cycloid gear: as many waves a turn of the joint as it has pins, and half the waves as sharp, wandering
by a tenth.
"""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="transmission ripple, cycloid order",
    unit="N m",
    typical=lambda robot, j: 0.3 * robot.chain[j].coulomb,
    values={"pins": 40.0, "phase": 1.2},
    torque="""
const double x = pins * q + phase;
return size * wander(t, 0.1, phase) * (cos(x) + 0.4 * cos(2.0 * x + 1.1));
    """,
)
