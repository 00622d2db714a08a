"""Stribeck friction as LuGre has it: a bristle whose strength falls with exp(-(v / speed)^2) and which lags.

It comes on top of Coulomb friction, so that size is the breakaway's excess.
"""

from __future__ import annotations

from tests.plant.law import Law, stiff_way

LAW = Law(
    about="Stribeck friction",
    unit="N m",
    typical=lambda robot, j: 0.5 * robot.chain[j].coulomb,
    values={"speed": lambda robot, j: 0.06 * robot.chain[j].range[2], "distance": stiff_way},
    torque="""
const double x = v / speed;
return size * bristle(s, v, distance, exp(-x * x), h);
    """,
    friction=True,
)
