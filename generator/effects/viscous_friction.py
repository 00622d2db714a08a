"""Friction proportional to speed."""

from __future__ import annotations

from generator.effects.effect import EVERYWHERE, Column, Effect, LinearParameter, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(at.qd),)


EFFECT = Effect(
    id="viscous_friction",
    title="viscous friction",
    parameters=(LinearParameter("Fv", ("N m s/rad", "N s/m"), "viscous friction coefficient", 0.0),),
    columns=_columns,
    needs=("qd",),
    sign_convention="the motor supplies Fv qd against the friction",
    source="report eq. 5",
    drive_train=True,
    dissipates=True,
    rank=20,
    occurs=EVERYWHERE,
)
