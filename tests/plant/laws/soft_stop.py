"""A rubber buffer that is pressed beyond one place, as Hertz's contact yields, and at its limit after three widths."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="soft stop",
    unit="N m",
    typical=lambda robot, j: 1.0 * robot.chain[j].coulomb,
    values={"place": lambda robot, j: robot.centre[j] + 0.3, "width": 0.05},
    torque="return size * pow(fmax(0.0, fmin((q - place) / width, 3.0)), 1.5);",
    of_links=True,
    outside=True,
)
