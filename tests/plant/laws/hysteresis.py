"""Hysteresis by Bouc and Wen, which goes round over a way far longer than presliding."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="hysteresis (Bouc-Wen)",
    unit="N m",
    typical=lambda robot, j: 0.6 * robot.chain[j].coulomb,
    values={"way": 0.05, "beta": 0.7, "gamma_": 0.3},
    torque="""
const double before = s[0], grip = s[0] * v > 0.0 ? beta + gamma_ : gamma_ - beta;
s[0] += v * h / way * (1.0 - pow(fabs(s[0]), 1.5) * grip);
return size * 0.5 * (before + s[0]);
    """,
    friction=True,
)
