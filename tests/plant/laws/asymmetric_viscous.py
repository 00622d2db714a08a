"""Viscous friction that differs between the directions: size |v| comes on top."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="viscous friction, one direction stronger",
    unit="N m s/rad",
    typical=lambda robot, j: 0.2 * robot.chain[j].viscous,
    torque="return size * fabs(v);",
    friction=True,
)
