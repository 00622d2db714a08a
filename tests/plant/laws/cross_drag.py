"""A drag on this joint that the speed of another joint makes, as a shared bundle of hoses does."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="drag from another joint's speed",
    unit="N m",
    typical=lambda robot, j: 0.6 * robot.chain[j].coulomb,
    values={"speed": lambda robot, j: 0.1 * robot.chain[j].range[2]},
    torque="return size * v_other / (fabs(v_other) + speed);",
    outside=True,
)
