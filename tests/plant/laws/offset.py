"""A constant torque."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="offset",
    unit="N m",
    typical=lambda robot, j: 0.3 * robot.chain[j].coulomb,
    torque="return size;",
)
