"""Gravity balancer with a gas cylinder."""

from __future__ import annotations

from collections.abc import Mapping

import sympy

from generator.effects.effect import BALANCER, Column, Effect, LinearParameter, Positive, Shape, Site
from generator.effects.laws import gas
from generator.effects.mechanisms import crank
from generator.robot.description import REVOLUTE

#: Part of the chamber's length that is left at least: no cylinder is squeezed to a tenth.
_ROOM = 0.1


def _chamber(at: Site) -> sympy.Expr:
    """Length L of the gas chamber [m] (report eq. 35)."""
    return at.values["l0"] - crank.length(at) + crank.length_at_zero(at)


def _force(at: Site) -> sympy.Expr:
    return gas.force_column(_chamber(at), at.values["l0"], at.values["exponent"])


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(_force(at) * crank.lever_arm(at)),)


def _energy(at: Site) -> tuple[sympy.Expr, ...]:
    return (gas.energy_column(_chamber(at), at.values["l0"], at.values["exponent"]),)


def _positive(at: Site) -> tuple[Positive, ...]:
    return crank.apart(at), Positive("l0", _chamber(at), "too small", "a longer one", _ROOM)


def _observables(at: Site) -> Mapping[str, tuple[sympy.Expr, str, str]]:
    return crank.observables(at, sympy.Symbol("F0", real=True) * _force(at))


EFFECT = Effect(
    id="gas_balancer",
    title="gas balancer",
    parameters=(LinearParameter("F0", ("N", "N"), "force of the balancer at q = 0", 0.0),),
    columns=_columns,
    potential_energy=_energy,
    positive=_positive,
    extremes=crank.extremes,
    observables=_observables,
    shapes=(
        *crank.SHAPES,
        Shape("l0", "m", "length of the gas chamber at q = 0", lower=0.0, tried=(0.35, 0.7, 2.0)),
        Shape(
            "exponent",
            "1",
            "polytropic exponent, 1 for an isotherm",
            lower=0.0,
            default=sympy.Integer(1),
            tried=(1.0, 1.3),
        ),
    ),
    kinds=(REVOLUTE,),
    needs=("q",),
    on_link=True,
    sign_convention="F1 > 0 pulls the pivots together; F1 dr24/dq adds to the inverse dynamic model",
    assumptions="ideal gas in a closed chamber of constant cross-section; massless; the pivots do not rub",
    source="report eq. 33-38",
    role=BALANCER,
    resembles={
        "spring_balancer": "motion over the joint's whole range: gas stiffens as it is compressed, a spring does not"
    },
)
