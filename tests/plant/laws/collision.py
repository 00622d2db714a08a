"""A blow of some hundredths of a second, as Hertz's contact makes it; an effect's weights spread it over joints."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="collision",
    unit="N m",
    typical=lambda robot, j: 4 * robot.chain[j].coulomb,
    values={"start": 3.0, "last": 0.08},
    torque="""
const double x = (t - start) / last;
return x > 0.0 && x < 1.0 ? size * pow(sin(3.14159265358979 * x), 1.5) : 0.0;
    """,
    of_links=True,
    outside=True,
)
