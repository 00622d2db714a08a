"""Presliding by Dahl with exponent 2: dz/dx = (1 - z sign(v))^2 / way, which creeps to its end like a hyperbola."""

from __future__ import annotations

from tests.plant.law import Law, stiff_way

LAW = Law(
    about="presliding displacement (Dahl)",
    unit="N m",
    typical=lambda robot, j: 0.8 * robot.chain[j].coulomb,
    largest=lambda robot, j: robot.chain[j].coulomb,
    replaces_coulomb=True,
    values={"way": 5e-3, "distance": stiff_way},
    torque="""
const double side = v > 0.0 ? 1.0 : (v < 0.0 ? -1.0 : 0.0), before = s[0], u = 1.0 - side * s[0];
s[0] = side != 0.0 ? side * (1.0 - u / (1.0 + u * fabs(v) * h / way)) : s[0];
return size * (0.5 * (before + s[0]) - bristle(s + 1, v, distance, 1.0, h));
    """,
    friction=True,
)
