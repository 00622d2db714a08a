"""Friction that rises from nothing at rest to a constant: without the jump of Coulomb's."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(sympy.tanh(at.qd / at.values["v0"])),)


_TRIED = (0.01, 0.03, 0.1, 0.3)

EFFECT = Effect(
    id="gradual_friction",
    title="friction that rises gradually from rest",
    parameters=(LinearParameter("Fg", ("N m", "N"), "friction far from rest", 0.0),),
    columns=_columns,
    shapes=(
        Shape(
            "v0", "rad/s", "speed within which the friction rises", 0.0, prismatic="m/s", tried=_TRIED, relative="speed"
        ),
    ),
    needs=("qd",),
    sign_convention="the motor supplies Fg tanh(qd/v0) against the friction",
    assumptions="nothing sticks: a joint at rest creeps under any torque",
    source=(
        "Andersson, Soderberg and Bjorklund, Friction models for sliding dry, boundary and mixed lubricated contacts, "
        "Tribology International 40, 2007"
    ),
    dissipates=True,
    rank=74,
)
