"""Friction that grows with the torque that a transmission carries."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(sympy.sign(at.qd) * sympy.Abs(at.load - at.values["rotor"] * at.qdd)),)


EFFECT = Effect(
    id="load_friction",
    title="friction that grows with the load",
    parameters=(LinearParameter("Fl", ("1", "1"), "friction per torque that the transmission carries", 0.0, 1.0),),
    columns=_columns,
    shapes=(
        Shape(
            "rotor",
            "kg m2",
            "inertia of the rotor, which the transmission does not carry",
            0.0,
            default=sympy.S.Zero,
            prismatic="kg",
            tried=(1 / 16, 1 / 4, 1.0),
            relative="rotor",
        ),
    ),
    needs=("qd", "qdd", "load"),
    sign_convention="the motor supplies Fl sign(qd) |load - rotor qdd| against the friction; sign(0) = 0",
    assumptions=(
        "the load is all that the drive supplies beyond the joint's other friction: the torque of bodies, rotors, "
        "balancers, springs, ripple and offsets, and of the tool's wrench. The same in both directions of the power. "
        "Fl < 1, and rotor no more than the inertia that the joint feels. Where the drive train is elastic the spring "
        "is what carries: rotor counts in the rigid model alone"
    ),
    source=(
        "Hamon, Gautier and Garrec, Dynamic identification of robots with a dry friction model depending on load and "
        "velocity, IROS 2010"
    ),
    dissipates=True,
    rank=75,
    resembles={"position_friction": "the same motion with another payload"},
)
