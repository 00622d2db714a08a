"""Elasticity of a drive train, concentrated between the motor and its joint."""

from __future__ import annotations

from generator.effects.effect import Column, Effect, LinearParameter, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(-at.elongation),)


EFFECT = Effect(
    id="joint_elasticity",
    title="elasticity of the drive train",
    parameters=(LinearParameter("k", ("N m/rad", "N/m"), "stiffness of the drive train, on the joint side", 0.0),),
    columns=_columns,
    potential_energy=lambda at: (at.elongation**2 / 2,),
    needs=("qe",),
    sign_convention="q_a = q_m + q_e; the joint receives -k q_e, and so does the motor's torque balance",
    assumptions="linear, without damping of its own; one elastic coordinate per moving joint",
    source="report eq. 7, 8",
    drive_train=True,
    rank=50,
)
