"""What turns with the motor's shaft: a torque that repeats ``order`` times a turn, at the phase order q_r."""

from __future__ import annotations

import sympy

from generator.effects.effect import Column, Site
from generator.effects.laws import ripple

#: What a robot with coupled drives adds to the sign convention.
SHARED = "q_r = N q; other joints j that turn motor i get the share N_ij/N_ii, by equal power"


def ripple_columns(at: Site) -> tuple[Column, ...]:
    """Torque on the motor per unit of each part."""
    return tuple(at.on_motor(one) for one in ripple.torque_columns(_phase(at)))


def ripple_energy(at: Site) -> tuple[sympy.Expr, ...]:
    """Energy per unit of each part [J/unit]."""
    return ripple.energy_columns(_phase(at), at.values["order"] * at.ratios[at.joint.number])


def _phase(at: Site) -> sympy.Expr:
    return at.values["order"] * at.motor
