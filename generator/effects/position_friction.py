"""Coulomb friction that varies over the turn of a joint: a bearing out of true, a tight spot of a gear."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site
from generator.robot.description import REVOLUTE


def _columns(at: Site) -> tuple[Column, ...]:
    direction, phase = sympy.sign(at.qd), at.values["order"] * at.q
    return at.on_joint(direction * sympy.cos(phase)), at.on_joint(direction * sympy.sin(phase))


EFFECT = Effect(
    id="position_friction",
    title="friction that varies with the position",
    parameters=(
        LinearParameter("Fqc", ("N m", "N"), "cosine part of the friction's variation"),
        LinearParameter("Fqs", ("N m", "N"), "sine part of the friction's variation"),
    ),
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
    sign_convention="the motor supplies sign(qd) (Fqc cos(order q) + Fqs sin(order q)); sign(0) = 0",
    assumptions="a variation of Coulomb friction, which must be at least sqrt(Fqc^2 + Fqs^2)",
    source="Armstrong-Helouvry, Control of Machines with Friction, 1991",
    rank=76,
)
