"""A bundle of cables that holds the link back: a spring that hardens by a tenth at one radian."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="cable spring",
    unit="N m/rad",
    typical=lambda robot, j: 0.4 * robot.chain[j].coulomb,
    values={"rest": lambda robot, j: robot.centre[j]},
    torque="""
const double x = q - rest;
return size * (x + 0.1 * x * x * x);
    """,
    of_links=True,
)
