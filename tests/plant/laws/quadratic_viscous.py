"""Churning oil: size v |v|."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="friction with the square of speed",
    unit="N m s2/rad2",
    typical=lambda robot, j: 0.3 * robot.chain[j].viscous / robot.chain[j].range[2],
    torque="return size * v * fabs(v);",
    friction=True,
)
