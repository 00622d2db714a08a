"""A gear that gives way and does not come back the way it went: Bouc and Wen."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site, State


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(at.state("zh")),)


def _rates(at: Site) -> tuple[sympy.Expr, ...]:
    z = at.state("zh")
    grown = sympy.Abs(z) ** at.values["exponent"]
    return ((at.qd - grown * (at.qd + sympy.Abs(at.qd) * sympy.sign(z)) / 2) / at.values["xs"],)


EFFECT = Effect(
    id="hysteresis",
    title="hysteresis by Bouc and Wen",
    parameters=(LinearParameter("Fh", ("N m", "N"), "torque that a long motion one way ends at", 0.0),),
    columns=_columns,
    shapes=(
        Shape(
            "xs",
            "rad",
            "motion in which the torque would build up with its first stiffness",
            0.0,
            prismatic="m",
            tried=(3e-3, 1e-2, 3e-2, 1e-1, 3e-1),
            relative="way",
        ),
        Shape(
            "exponent",
            "1",
            "sharpness of the bend from elastic to yielding",
            0.0,
            10.0,
            default=sympy.Integer(2),
            tried=(2,),
            within=(0.7, 6),
        ),
    ),
    states=(State("zh", ("1", "1"), "part of the torque that is built up, -1 to 1"),),
    rates=_rates,
    needs=("state",),
    sign_convention=(
        "the motor supplies Fh zh, zh' = (qd - |zh|^exponent (qd + |qd| sign(zh))/2)/xs; unloading is elastic"
    ),
    assumptions="does not depend on the speed; Fh/xs is the first stiffness and that of every return",
    source="Wen, Method for random vibration of hysteretic systems, J. Engineering Mechanics Division ASCE 102, 1976",
    rank=79,
)
