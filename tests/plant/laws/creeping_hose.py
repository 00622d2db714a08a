"""A bundle of hoses that pulls the link back and lets go while it stays: a spring in series with a damper."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="pull of a bundle that creeps",
    unit="N m/rad",
    typical=lambda robot, j: 3.0 * robot.chain[j].coulomb / (robot.chain[j].range[1] - robot.chain[j].range[0]),
    values={"slow": 0.7},
    torque="""
const double before = s[0];
s[0] = (s[0] + v * h) / (1.0 + h / slow);
return size * 0.5 * (before + s[0]);
    """,
    of_links=True,
    outside=True,
)
