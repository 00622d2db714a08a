"""Friction of constant size against the motion, of another size in each direction."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Site


def _columns(at: Site) -> tuple[Column, ...]:
    # At rest half of the difference is left: the middle of all the values that the friction can take there.
    direction = sympy.sign(at.qd)
    return at.on_joint((direction + 1) / 2), at.on_joint((direction - 1) / 2)


EFFECT = Effect(
    id="asymmetric_coulomb",
    title="Coulomb friction that depends on the direction",
    parameters=(
        LinearParameter("Fcp", ("N m", "N"), "Coulomb friction coefficient for qd > 0", 0.0),
        LinearParameter("Fcn", ("N m", "N"), "Coulomb friction coefficient for qd < 0", 0.0),
    ),
    columns=_columns,
    needs=("qd",),
    sign_convention="the motor supplies Fcp where qd > 0 and -Fcn where qd < 0, against the friction",
    assumptions=(
        "stands for moving joints only; at rest friction takes any value between -Fcn and Fcp, of which sign(0) = 0 "
        "gives the middle; symmetric Coulomb friction with an offset is the same torque"
    ),
    source="Armstrong-Helouvry, Control of Machines with Friction, 1991",
    dissipates=True,
    rank=71,
)
