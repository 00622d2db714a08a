"""Friction that grows with the torque that a transmission carries."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Effect, LinearParameter, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(sympy.sign(at.qd) * sympy.Abs(at.load)),)


EFFECT = Effect(
    id="load_friction",
    title="friction that grows with the load",
    parameters=(LinearParameter("Fl", ("1", "1"), "friction per torque that the transmission carries", 0.0),),
    columns=_columns,
    needs=("qd", "load"),
    sign_convention="the motor supplies Fl sign(qd) |load| against the friction; sign(0) = 0",
    assumptions=(
        "the load is what the drive supplies beyond the joint's other friction and offset: the torque of bodies, "
        "rotors, balancers and springs, and of the tool's wrench. Rotors count, since base parameters hold them "
        "together with the bodies. The same in both directions of the power. Fl < 1"
    ),
    source=(
        "Hamon, Gautier and Garrec, Dynamic identification of robots with a dry friction model depending on load and "
        "velocity, IROS 2010"
    ),
    dissipates=True,
    rank=75,
)
