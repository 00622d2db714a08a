"""Constant torque: current offset and asymmetry of the Coulomb friction."""

from __future__ import annotations

import sympy

from generator.effects.effect import EVERYWHERE, Column, Effect, LinearParameter, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(sympy.Integer(1)),)


EFFECT = Effect(
    id="offset",
    title="torque offset",
    parameters=(LinearParameter("Off", ("N m", "N"), "offset of the torque and asymmetry of the Coulomb friction"),),
    columns=_columns,
    needs=(),
    sign_convention="the measured torque holds + Off",
    source="report, section 2.1.2",
    drive_train=True,
    rank=40,
    occurs=EVERYWHERE,
)
