"""A rubber buffer that is touched near one end of the motion."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="soft stop",
    unit="N m",
    typical=lambda robot, j: 1.0 * robot.chain[j].coulomb,
    values={"place": lambda robot, j: robot.centre[j] + 0.3, "width": 0.05},
    torque="return size * exp(fmin((q - place) / width, 4.0));",
    of_links=True,
    outside=True,
)
