"""Inertia of the rotor and of the drive train, seen on the joint side."""

from __future__ import annotations

from generator.effects.effect import EVERYWHERE, Column, Effect, LinearParameter, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(at.qdd),)


EFFECT = Effect(
    id="rotor_inertia",
    title="rotor and drive-train inertia",
    parameters=(LinearParameter("Ia", ("kg m2", "kg"), "inertia of rotor and drive train about their axis", 0.0),),
    columns=_columns,
    kinetic_energy=lambda at: (at.qd**2 / 2,),
    needs=("qdd",),
    sign_convention="the motor supplies Ia qdd",
    assumptions="the rotor turns in proportion to its joint; gyroscopic terms of the rotor are neglected",
    source="report eq. 5",
    drive_train=True,
    rank=10,
    occurs=EVERYWHERE,
)
