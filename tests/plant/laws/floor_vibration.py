"""A torque of one frequency in time, whatever the robot does: a machine beside it."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="vibration from outside",
    unit="N m",
    typical=lambda robot, j: 0.4 * robot.chain[j].coulomb,
    values={"frequency": 7.3, "phase": 0.3},
    torque="return size * sin(6.28318530717959 * frequency * t + phase);",
    of_links=True,
    outside=True,
)
