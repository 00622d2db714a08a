"""Torque that repeats with the turns of a motor: cogging, current offsets, an eccentric rotor."""

from __future__ import annotations

from generator.effects.effect import Effect
from generator.effects.laws import ripple
from generator.effects.mechanisms.motor_shaft import SHARED, ripple_columns, ripple_energy

_TRIED = (1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0)

EFFECT = Effect(
    id="motor_ripple",
    title="torque ripple of the motor",
    parameters=ripple.parameters("Rm", ("N m", "N"), "the motor's ripple, on the joint side"),
    columns=ripple_columns,
    potential_energy=ripple_energy,
    shapes=(ripple.order("motor", _TRIED, default=1),),
    needs=("motor",),
    sign_convention="the motor supplies Rmc cos(order q_r) + Rms sin(order q_r) + the second harmonic; " + SHARED,
    assumptions="a torque of the position alone: its amplitude does not depend on the current",
    source=(
        "Mattavelli, Tubiana and Zigliotto, Torque-ripple reduction in PM synchronous motor drives using repetitive "
        "current control, IEEE Transactions on Power Electronics 20, 2005"
    ),
    rank=80,
)
