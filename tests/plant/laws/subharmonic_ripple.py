"""Ripple at an order of the motor's turn below one, as a worn bearing's cage makes."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="ripple below the motor's first order",
    unit="N m",
    typical=lambda robot, j: 0.4 * robot.chain[j].coulomb,
    values={"order": 0.3819, "phase": 0.9},
    torque="return size * wander(t, 0.1, phase) * cos(order * rotor + phase);",
    outside=True,
    of_motor=True,
)
