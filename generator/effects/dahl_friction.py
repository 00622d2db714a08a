"""Friction that yields before it slides: bristles that bend, by Dahl."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site, State


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(at.state("zd")),)


def _rates(at: Site) -> tuple[sympy.Expr, ...]:
    return ((at.qd - sympy.Abs(at.qd) * at.state("zd")) / at.values["xs"],)


EFFECT = Effect(
    id="dahl_friction",
    title="presliding friction by Dahl",
    parameters=(LinearParameter("Fd", ("N m", "N"), "friction that sliding ends at", 0.0),),
    columns=_columns,
    shapes=(
        Shape(
            "xs",
            "rad",
            "motion in which the friction builds up",
            0.0,
            prismatic="m",
            tried=(3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1),
            relative="way",
        ),
    ),
    states=(State("zd", ("1", "1"), "part of the friction that is built up, -1 to 1"),),
    rates=_rates,
    needs=("state",),
    sign_convention="the motor supplies Fd zd against the friction, zd' = (qd - |qd| zd)/xs",
    assumptions="does not depend on the speed; Fd/xs is the stiffness at rest; a joint under a steady load creeps",
    source="Dahl, A solid friction model, Aerospace Corporation TOR-0158(3107-18)-1, 1968",
    rank=77,
    resembles={"stribeck_friction": "slow reversals: presliding depends on the way, Stribeck on the speed"},
)
