"""Elasticity of a drive train, concentrated between the motor and its joint, with backlash if it has any."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site


def _wound(at: Site) -> sympy.Expr:
    """What the elongation winds the spring by: all of it beyond half of the gap either way [rad]."""
    half = at.values["gap"] / 2
    return at.elongation - (sympy.Abs(at.elongation + half) - sympy.Abs(at.elongation - half)) / 2


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(-_wound(at)),)


EFFECT = Effect(
    id="joint_elasticity",
    title="elasticity of the drive train",
    parameters=(LinearParameter("k", ("N m/rad", "N/m"), "stiffness of the drive train, on the joint side", 0.0),),
    columns=_columns,
    potential_energy=lambda at: (_wound(at) ** 2 / 2,),
    shapes=(Shape("gap", "rad", "backlash", 0.0, default=sympy.Integer(0), prismatic="m"),),
    needs=("qe",),
    sign_convention="q_a = q_m + q_e; the joint receives -k q_e, and so does the motor's torque balance",
    assumptions="linear beyond the gap, in whose middle q_e is 0, without damping of its own; one coordinate per joint",
    source="report eq. 7, 8; the gap as a dead zone: Nordin and Gutman, Controlling mechanical systems with backlash, "
    "Automatica 38, 2002",
    drive_train=True,
    rank=50,
)
