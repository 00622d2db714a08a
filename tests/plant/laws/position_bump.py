"""A hill in the torque at one place, like a rubbing cover that gives way again."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="torque bump at one position",
    unit="N m",
    typical=lambda robot, j: 0.6 * robot.chain[j].coulomb,
    values={"place": lambda robot, j: robot.centre[j] + 0.1, "width": 0.08},
    torque="""
const double x = (q - place) / width;
return size * exp(-x * x);
    """,
    of_links=True,
    outside=True,
)
