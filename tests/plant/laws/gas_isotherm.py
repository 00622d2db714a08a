"""A gas cylinder on a crank whose gas keeps its temperature: force times chamber is constant; size is the force at q
= 0.
"""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="gas balancer, isotherm",
    unit="N",
    typical=lambda robot, j: 10 * robot.chain[j].coulomb,
    values={"d21": 0.7, "d22": 0.18, "phi": -1.6, "l0": 0.5},
    torque="""
const double chamber = l0 - crank_length(q, d21, d22, phi) + crank_length(0.0, d21, d22, phi);
return crank_torque(q, d21, d22, phi, size * l0 / chamber);
    """,
    of_links=True,
)
