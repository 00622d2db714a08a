"""Torque that repeats with the turns of a motor: cogging, current offsets, an eccentric rotor."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site
from generator.effects.laws import ripple
from generator.robot.description import REVOLUTE


def _phase(at: Site) -> sympy.Expr:
    return at.values["order"] * at.motor


def _columns(at: Site) -> tuple[Column, ...]:
    cosine, sine = ripple.torque_columns(_phase(at))
    return at.on_motor(cosine), at.on_motor(sine)


EFFECT = Effect(
    id="motor_ripple",
    title="torque ripple of the motor",
    parameters=(
        LinearParameter("Rmc", ("N m", "N"), "cosine part of the motor's ripple, on the joint side"),
        LinearParameter("Rms", ("N m", "N"), "sine part of the motor's ripple, on the joint side"),
    ),
    columns=_columns,
    potential_energy=lambda at: ripple.energy_columns(_phase(at), at.values["order"] * at.ratios[at.joint.number]),
    shapes=(Shape("order", "1", "periods per turn of the motor", lower=0.0, default=sympy.Integer(1)),),
    kinds=(REVOLUTE,),
    needs=("motor",),
    sign_convention="the motor supplies Rmc cos(order q_r) + Rms sin(order q_r), q_r = N q its position",
    assumptions="a torque of the position alone: its amplitude does not depend on the current",
    source=(
        "Mattavelli, Tubiana and Zigliotto, Torque-ripple reduction in PM synchronous motor drives using repetitive "
        "current control, IEEE Transactions on Power Electronics 20, 2005"
    ),
    rank=80,
)
