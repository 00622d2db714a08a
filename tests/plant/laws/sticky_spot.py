"""Friction that is stronger over some degrees: a dent in a race."""

from __future__ import annotations

from tests.plant.law import Law, stiff_way

LAW = Law(
    about="friction at one position",
    unit="N m",
    typical=lambda robot, j: 0.8 * robot.chain[j].coulomb,
    values={"place": lambda robot, j: robot.centre[j], "width": 0.06, "distance": stiff_way},
    torque="""
const double x = (q - place) / width;
return size * exp(-x * x) * bristle(s, v, distance, 1.0, h);
    """,
    friction=True,
    outside=True,
)
