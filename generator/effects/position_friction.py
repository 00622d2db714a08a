"""Coulomb friction that varies over the turn of a joint: a bearing out of true, a tight spot of a gear."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, Shape, Site
from generator.effects.laws import ripple
from generator.robot.description import REVOLUTE


def _columns(at: Site) -> tuple[Column, ...]:
    direction, phase = sympy.sign(at.qd), at.values["order"] * at.q
    return tuple(at.on_joint(direction * one) for one in ripple.torque_columns(phase))


EFFECT = Effect(
    id="position_friction",
    title="friction that varies with the position",
    parameters=ripple.parameters("Fq", ("N m", "N"), "the friction's variation"),
    columns=_columns,
    shapes=(
        Shape(
            "order",
            "1",
            "periods per turn of the joint",
            lower=0.0,
            default=sympy.Integer(1),
            tried=(1.0, 2.0, 3.0),
            whole=True,
        ),
    ),
    kinds=(REVOLUTE,),
    needs=("q", "qd"),
    sign_convention="the motor supplies sign(qd) (Fqc cos(order q) + Fqs sin(order q) + second harmonic); sign(0) = 0",
    assumptions="a variation of Coulomb friction, which must be at least as large",
    source="Armstrong-Helouvry, Control of Machines with Friction, 1991",
    rank=76,
)
