"""A torque in the joint's sine that grows while a cylinder loses its gas."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="leaking balancer",
    unit="N m",
    typical=lambda robot, j: 1.0 * robot.chain[j].coulomb,
    values={"slow": 60.0},
    torque="return size * sin(q) * (1.0 - exp(-t / slow));",
    of_links=True,
    outside=True,
)
