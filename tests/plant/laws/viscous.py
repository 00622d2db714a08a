"""Viscous friction of the motor's side: F v."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="viscous friction",
    unit="N m s/rad",
    typical=lambda robot, j: robot.chain[j].viscous,
    torque="return size * v;",
    friction=True,
)
