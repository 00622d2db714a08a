"""A torque that repeats with a turning part: Rc cos(phase) + Rs sin(phase), and the energy that it swings with."""

from __future__ import annotations

import sympy


def torque_columns(phase: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    """Torque per unit of the cosine and of the sine part."""
    return sympy.cos(phase), sympy.sin(phase)


def energy_columns(phase: sympy.Expr, slope: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    """Energy per unit of either part, zero at phase 0; ``slope`` is the phase per position of the joint."""
    return sympy.sin(phase) / slope, (1 - sympy.cos(phase)) / slope
