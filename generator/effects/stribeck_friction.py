"""Friction that falls as a lubricant's film builds up: what standing friction has beyond Coulomb's."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site


def _columns(at: Site) -> tuple[Column, ...]:
    relative = sympy.Abs(at.qd) / at.values["vs"]
    return (at.on_joint(sympy.sign(at.qd) * sympy.exp(-(relative ** at.values["exponent"]))),)


_TRIED = (0.02, 0.05, 0.1, 0.2, 0.4)

EFFECT = Effect(
    id="stribeck_friction",
    title="Stribeck friction",
    parameters=(LinearParameter("Fst", ("N m", "N"), "friction beyond Coulomb's just above rest", 0.0),),
    columns=_columns,
    shapes=(
        Shape(
            "vs",
            "rad/s",
            "Stribeck speed, within which the friction falls",
            0.0,
            prismatic="m/s",
            tried=_TRIED,
            relative="speed",
        ),
        Shape(
            "exponent",
            "1",
            "form of the fall: 1 by Tustin, 2 a bell",
            0.0,
            5.0,
            default=sympy.Integer(2),
            tried=(1.0, 2.0),
        ),
    ),
    needs=("qd",),
    sign_convention="the motor supplies Fst sign(qd) exp(-(|qd|/vs)^exponent) against the friction",
    assumptions="stands for moving joints only; sign(0) = 0; added to Coulomb and viscous friction",
    source=(
        "Bo and Pavelescu, The friction-speed relation and its influence on the critical velocity of stick-slip motion"
        ", Wear 82, 1982"
    ),
    dissipates=True,
    rank=73,
)
