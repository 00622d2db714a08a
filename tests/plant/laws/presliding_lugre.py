"""Presliding by LuGre: size of the Coulomb friction sits on soft bristles, which are stiffer against breakaway than
in motion.
"""

from __future__ import annotations

from tests.plant.law import Law, stiff_way

LAW = Law(
    about="presliding displacement (LuGre)",
    unit="N m",
    typical=lambda robot, j: 0.8 * robot.chain[j].coulomb,
    largest=lambda robot, j: robot.chain[j].coulomb,
    replaces_coulomb=True,
    values={"way": 1e-2, "speed": lambda robot, j: 0.02 * robot.chain[j].range[2], "distance": stiff_way},
    torque="""
const double x = v / speed, strength = 1.0 + 0.15 * exp(-x * x);
return size * (bristle(s, v, way, strength, h) - bristle(s + 1, v, distance, 1.0, h));
    """,
    friction=True,
)
