"""Shear thinning: size v / (1 + |v| / speed), which bends where a power law or a cube root would not."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="concave viscous friction",
    unit="N m s/rad",
    typical=lambda robot, j: 0.5 * robot.chain[j].viscous,
    values={"speed": lambda robot, j: 0.2 * robot.chain[j].range[2]},
    torque="return size * v / (1.0 + fabs(v) / speed);",
    friction=True,
)
