"""Friction that rises gradually from zero speed, by an arctangent: size of the Coulomb friction is replaced.

A hyperbolic tangent is at its end at three times the speed; this one has a long tail.
"""

from __future__ import annotations

from tests.plant.law import Law, stiff_way

LAW = Law(
    about="friction rising gradually from zero speed",
    unit="N m",
    typical=lambda robot, j: 0.6 * robot.chain[j].coulomb,
    largest=lambda robot, j: robot.chain[j].coulomb,
    replaces_coulomb=True,
    values={"speed": lambda robot, j: 0.03 * robot.chain[j].range[2], "distance": stiff_way},
    torque="""
const double smooth = 0.63661977236758134 * atan(v / speed);
return size * (smooth - bristle(s, v, distance, 1.0, h));
    """,
    friction=True,
)
