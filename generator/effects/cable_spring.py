"""Hoses and cables along the arm that pull a joint back to where they hang free."""

from __future__ import annotations

import sympy

from generator.effects.effect import SPRING, Column, Effect, LinearParameter, Shape, Site


def _columns(at: Site) -> tuple[Column, ...]:
    way = at.q - at.values["neutral"]
    return at.on_joint(way), at.on_joint(way**3)


def _energy(at: Site) -> tuple[sympy.Expr, ...]:
    neutral = at.values["neutral"]
    return at.q * (at.q / 2 - neutral), ((at.q - neutral) ** 4 - neutral**4) / 4


EFFECT = Effect(
    id="cable_spring",
    title="cable spring",
    parameters=(
        LinearParameter("kc", ("N m/rad", "N/m"), "stiffness of hoses and cables", 0.0),
        LinearParameter("kch", ("N m/rad3", "N/m3"), "how it hardens with the cube of the way", 0.0, refines=True),
    ),
    columns=_columns,
    potential_energy=_energy,
    shapes=(
        Shape(
            "neutral",
            "rad",
            "position where nothing pulls",
            prismatic="m",
            tried=(-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0),
            relative="position",
        ),
    ),
    needs=("q",),
    on_link=True,
    sign_convention="the motor supplies kc (q - neutral) + kch (q - neutral)^3 against the pull",
    assumptions="massless, without friction of its own; hardens alike both ways",
    source="Hooke's law; the cubic term of Duffing 1918",
    rank=65,
    role=SPRING,
    resembles={
        "joint_spring": "the position in which the hose hangs loose: beside an offset both are one torque, unless it "
        "stiffens as it bends"
    },
)
