"""Friction that grows with a power of the speed: faster than the speed (fans, churned oil) or slower (grease)."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site


def _columns(at: Site) -> tuple[Column, ...]:
    relative = sympy.Abs(at.qd) / at.values["v"]
    return (at.on_joint(sympy.sign(at.qd) * relative ** at.values["exponent"]),)


EFFECT = Effect(
    id="power_friction",
    title="friction by a power of the speed",
    parameters=(LinearParameter("Fp", ("N m", "N"), "friction at the reference speed v", 0.0),),
    columns=_columns,
    shapes=(
        Shape("v", "rad/s", "reference speed", lower=0.0, default=sympy.Integer(1), prismatic="m/s"),
        Shape(
            "exponent",
            "1",
            "power of the speed: 2 quadratic, below 1 concave",
            0.0,
            5.0,
            default=sympy.Integer(2),
            tried=(0.3, 0.5, 0.7, 1.5, 2.0, 3.0),
        ),
    ),
    needs=("qd",),
    sign_convention="the motor supplies Fp sign(qd) (|qd|/v)^exponent against the friction",
    assumptions="with an exponent below 1 the slope at rest is infinite",
    source=(
        "Waiboer, Aarts and Jonker, Velocity dependence of joint friction in robotic manipulators with gear "
        "transmissions, ECCOMAS Multibody Dynamics 2005"
    ),
    dissipates=True,
    rank=72,
)
