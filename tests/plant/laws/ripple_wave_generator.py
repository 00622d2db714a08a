"""Ripple of a strain wave gear: twice a turn of the wave generator, stronger under load, wandering by a tenth."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="transmission ripple, wave generator order",
    unit="N m",
    typical=lambda robot, j: 0.3 * robot.chain[j].coulomb,
    values={"phase": 2.0, "load_scale": lambda robot, j: 4.0 * robot.chain[j].coulomb},
    torque="""
const double stress = load / load_scale, x = 2.0 * rotor + phase;
return size * wander(t, 0.1, phase) * (0.8 + 0.2 * sqrt(1.0 + stress * stress)) * cos(x);
    """,
    of_motor=True,
)
