"""Friction of constant size against the motion."""

from __future__ import annotations

import sympy

from generator.effects.effect import EVERYWHERE, Column, Effect, LinearParameter, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(sympy.sign(at.qd)),)


EFFECT = Effect(
    id="coulomb_friction",
    title="Coulomb friction",
    parameters=(LinearParameter("Fc", ("N m", "N"), "Coulomb friction coefficient", 0.0),),
    columns=_columns,
    needs=("qd",),
    sign_convention="the motor supplies Fc sign(qd) against the friction; sign(0) = 0",
    assumptions="stands for moving joints only; at rest friction takes any value between -Fc and Fc",
    source="report eq. 5",
    drive_train=True,
    dissipates=True,
    rank=30,
    occurs=EVERYWHERE,
)
