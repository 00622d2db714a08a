"""Torque that repeats with a cycloidal gear: with its pins and lobes, whose number is the order."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, Site
from generator.effects.laws import ripple
from generator.robot.description import REVOLUTE


def _phase(at: Site) -> sympy.Expr:
    return at.values["order"] * at.q


def _columns(at: Site) -> tuple[Column, ...]:
    return tuple(at.on_joint(one) for one in ripple.torque_columns(_phase(at)))


EFFECT = Effect(
    id="cycloid_ripple",
    title="torque ripple of the cycloid",
    parameters=ripple.parameters("Ry", ("N m", "N"), "the cycloid's ripple, on the joint side"),
    columns=_columns,
    potential_energy=lambda at: ripple.energy_columns(_phase(at), at.values["order"]),
    shapes=(ripple.order("joint", (1.0,), several=300),),
    kinds=(REVOLUTE,),
    needs=("q",),
    sign_convention="the motor supplies Ryc cos(order q) + Rys sin(order q) + the second harmonic",
    assumptions="no dependence on the load",
    source=(
        "Blanche and Yang, Cycloid drives with machining tolerances, Journal of Mechanisms, Transmissions and "
        "Automation in Design 111, 1989"
    ),
    rank=81,
    resembles=dict.fromkeys(
        ("motor_ripple", "wave_generator_ripple"),
        "what the gear's maker tells of it: where both have as many periods a turn they are one torque, but for a "
        "coupled wrist's",
    ),
)
