"""Friction that changes while a drive gets warm."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return at.on_joint(at.warmth * at.qd), at.on_joint(at.warmth * sympy.sign(at.qd))


EFFECT = Effect(
    id="warm_friction",
    title="drift of the friction with the drive's warmth",
    parameters=(
        LinearParameter("Fvw", ("N m s/rad", "N s/m"), "change of the viscous friction coefficient at warmth 1"),
        LinearParameter("Fcw", ("N m", "N"), "change of the Coulomb friction coefficient at warmth 1"),
    ),
    columns=_columns,
    needs=("qd", "warmth"),
    sign_convention="the motor supplies warmth (Fvw qd + Fcw sign(qd)) against the friction; usually both are negative",
    assumptions=(
        "linear in the warmth, which the caller states: 1 - exp(-t/T) after a cold start, or a temperature's rise over "
        "the rise that counts as 1"
    ),
    source=(
        "Bittencourt, Wernholt, Sander-Tavallaey and Brogardh, An extended friction model to capture load and "
        "temperature effects in robot joints, IROS 2010"
    ),
    rank=84,
    resembles={"torque_drift": "one long run with parts of constant speed"},
)
