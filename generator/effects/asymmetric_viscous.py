"""Friction proportional to speed, with one coefficient for each direction."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Site


def _columns(at: Site) -> tuple[Column, ...]:
    size = sympy.Abs(at.qd)
    return at.on_joint((at.qd + size) / 2), at.on_joint((at.qd - size) / 2)


EFFECT = Effect(
    id="asymmetric_viscous",
    title="viscous friction that depends on the direction",
    parameters=(
        LinearParameter("Fvp", ("N m s/rad", "N s/m"), "viscous friction coefficient for qd > 0", 0.0),
        LinearParameter("Fvn", ("N m s/rad", "N s/m"), "viscous friction coefficient for qd < 0", 0.0),
    ),
    columns=_columns,
    needs=("qd",),
    sign_convention="the motor supplies Fvp qd where qd > 0 and Fvn qd where qd < 0, against the friction",
    assumptions="beside symmetric viscous friction only the sums Fv + Fvp and Fv + Fvn show",
    source="Armstrong-Helouvry, Control of Machines with Friction, 1991",
    dissipates=True,
    rank=70,
)
