"""A spring on a crank, by the moment of its force about the joint; size is its stiffness."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="spring balancer",
    unit="N/m",
    typical=lambda robot, j: 20 * robot.chain[j].coulomb,
    values={"d21": 0.7, "d22": 0.18, "phi": -1.6, "free_length": 0.2},
    torque="return crank_torque(q, d21, d22, phi, size * (crank_length(q, d21, d22, phi) - free_length));",
    of_links=True,
)
