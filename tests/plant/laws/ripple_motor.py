"""Torque ripple at an order of the motor's turn, with a weak second harmonic and a slowly wandering amplitude."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="transmission ripple, motor order",
    unit="N m",
    typical=lambda robot, j: 0.3 * robot.chain[j].coulomb,
    values={"order": 1.0, "phase": 0.5},
    torque="""
const double x = order * rotor + phase;
return size * wander(t, 0.1, phase) * (cos(x) + 0.2 * cos(2.0 * x + 0.4));
    """,
    of_motor=True,
)
