"""Torque that repeats with a harmonic drive's wave generator, which turns with the motor: twice a turn, most of all."""

from __future__ import annotations

from generator.effects.effect import Effect
from generator.effects.laws import ripple
from generator.effects.mechanisms.motor_shaft import SHARED, ripple_columns, ripple_energy
from generator.robot.description import REVOLUTE

EFFECT = Effect(
    id="wave_generator_ripple",
    title="torque ripple of the wave generator",
    parameters=ripple.parameters("Rw", ("N m", "N"), "the wave generator's ripple, on the joint side"),
    columns=ripple_columns,
    potential_energy=ripple_energy,
    shapes=(ripple.order("wave generator", (2.0, 4.0), default=2),),
    kinds=(REVOLUTE,),
    needs=("motor",),
    sign_convention="the motor supplies Rwc cos(order q_r) + Rws sin(order q_r) + the second harmonic; " + SHARED,
    assumptions="the wave generator sits on the motor; no dependence on the load",
    source=(
        "Tuttle and Seering, A nonlinear model of a harmonic drive gear transmission, IEEE Transactions on Robotics "
        "and Automation 12, 1996"
    ),
    rank=82,
    resembles={
        "motor_ripple": "what the gear's maker tells of it: where both have as many periods a turn they are one torque"
    },
)
