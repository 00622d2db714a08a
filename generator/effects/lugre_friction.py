"""Friction that yields before it slides and falls as it slides faster: bristles with a Stribeck curve, LuGre."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site, State


def _bending(at: Site) -> sympy.Expr:
    """Speed at which the bristles bend [rad/s]: xs zl'."""
    sliding = 1 + at.values["excess"] * sympy.exp(-((at.qd / at.values["vs"]) ** 2))
    return at.qd - sympy.Abs(at.qd) * at.state("zl") / sliding


def _columns(at: Site) -> tuple[Column, ...]:
    return at.on_joint(at.state("zl")), at.on_joint(_bending(at))


EFFECT = Effect(
    id="lugre_friction",
    title="presliding friction by LuGre",
    parameters=(
        LinearParameter("Fz", ("N m", "N"), "Coulomb friction that fast sliding ends at", 0.0),
        LinearParameter("Dz", ("N m s/rad", "N s/m"), "damping of the bristles", 0.0, refines=True),
    ),
    columns=_columns,
    shapes=(
        Shape(
            "xs",
            "rad",
            "deflection of the bristles in fast sliding",
            0.0,
            prismatic="m",
            tried=(1e-3, 3e-3, 1e-2),
            relative="way",
        ),
        Shape(
            "excess",
            "1",
            "what friction has at rest beyond Coulomb's, as a part of that",
            0.0,
            tried=(0.5,),
            within=(0.05, 3.0),
        ),
        Shape(
            "vs",
            "rad/s",
            "Stribeck speed, within which the friction falls",
            0.0,
            prismatic="m/s",
            tried=(0.05,),
            within=(0.01, 0.3),
            relative="speed",
        ),
    ),
    states=(State("zl", ("1", "1"), "deflection of the bristles over xs"),),
    rates=lambda at: (_bending(at) / at.values["xs"],),
    needs=("qd", "state"),
    sign_convention="the motor supplies Fz zl + Dz xs zl', xs zl' = qd - |qd| zl/(1 + excess exp(-(qd/vs)^2))",
    assumptions="sigma_0 = Fz/xs, sigma_1 = Dz; sigma_2 is viscous friction; passive where Dz is not too large",
    source=(
        "Canudas de Wit, Olsson, Astrom and Lischinsky, A new model for control of systems with friction, IEEE "
        "Transactions on Automatic Control 40, 1995"
    ),
    rank=78,
    resembles={"stribeck_friction": "slow reversals at different accelerations"},
)
