"""What turns with the motor's shaft: a torque that repeats ``order`` times a turn, at the phase order q_r."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Site
from generator.effects.laws import ripple


def ripple_columns(at: Site) -> tuple[Column, ...]:
    """Torque on the motor per unit of the cosine and of the sine part."""
    cosine, sine = ripple.torque_columns(_phase(at))
    return at.on_motor(cosine), at.on_motor(sine)


def ripple_energy(at: Site) -> tuple[sympy.Expr, ...]:
    """Energy per unit of the cosine and of the sine part [J/unit]."""
    return ripple.energy_columns(_phase(at), at.values["order"] * at.ratios[at.joint.number])


def _phase(at: Site) -> sympy.Expr:
    return at.values["order"] * at.motor
