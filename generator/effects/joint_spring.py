"""A linear spring across a joint: what makes an elastic joint of an expanded chain elastic."""

from __future__ import annotations

from generator.effects.effect import SPRING, Column, Effect, LinearParameter, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(at.q),)


EFFECT = Effect(
    id="joint_spring",
    title="spring across the joint",
    parameters=(LinearParameter("ks", ("N m/rad", "N/m"), "stiffness of the spring", 0.0),),
    columns=_columns,
    potential_energy=lambda at: (at.q**2 / 2,),
    needs=("q",),
    on_link=True,
    sign_convention="the inverse dynamic model holds + ks q; a joint without a motor moves so that its torque is zero",
    assumptions="linear, relaxed at q = 0",
    source="report eq. 7",
    rank=60,
    role=SPRING,
)
