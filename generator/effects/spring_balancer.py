"""Gravity balancer with a linear spring."""

from __future__ import annotations

from collections.abc import Mapping

import sympy

from generator.effects.effect import BALANCER, Column, Effect, LinearParameter, Site
from generator.effects.laws import linear_spring
from generator.effects.mechanisms import crank
from generator.robot.description import REVOLUTE


def _columns(at: Site) -> tuple[Column, ...]:
    arm = crank.lever_arm(at)
    # Kr's column r dr/dq is written without the root that cancels in it.
    stiffness = sympy.cancel(crank.length(at) * arm)
    return at.on_joint(stiffness), at.on_joint(arm)


def _observables(at: Site) -> Mapping[str, tuple[sympy.Expr, str, str]]:
    per_kr, per_k0 = linear_spring.force_columns(crank.length(at))
    kr, k0 = sympy.symbols("Kr K0", real=True)
    return crank.observables(at, kr * per_kr + k0 * per_k0)


EFFECT = Effect(
    id="spring_balancer",
    title="spring balancer",
    parameters=(
        LinearParameter("Kr", ("N/m", "N/m"), "stiffness of the balancer's spring", 0.0),
        LinearParameter("K0", ("N", "N"), "force of the balancer's spring extrapolated to zero length"),
    ),
    columns=_columns,
    potential_energy=lambda at: linear_spring.energy_columns(crank.length(at), crank.length_at_zero(at)),
    positive=lambda at: (crank.apart(at),),
    extremes=crank.extremes,
    observables=_observables,
    shapes=crank.SHAPES,
    kinds=(REVOLUTE,),
    needs=("q",),
    on_link=True,
    sign_convention="F1 > 0 pulls the pivots together; F1 dr24/dq adds to the inverse dynamic model",
    assumptions="massless; the pivots do not rub",
    source="report eq. 19-32",
    role=BALANCER,
)
