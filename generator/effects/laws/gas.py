"""A gas cylinder: F L^g = F0 l0^g (report eq. 33-35 with g = 1, the isotherm; g > 1 a polytropic change of state)."""

from __future__ import annotations

import sympy


def force_column(chamber: sympy.Expr, start: sympy.Expr, exponent: sympy.Expr) -> sympy.Expr:
    """Force per unit of F0 at the chamber length ``chamber``, 1 at ``start``."""
    return (start / chamber) ** exponent


def energy_column(chamber: sympy.Expr, start: sympy.Expr, exponent: sympy.Expr) -> sympy.Expr:
    """Energy per unit of F0 [m] stored while the chamber shortens from ``start``."""
    if exponent == 1:
        return -start * sympy.log(chamber / start)
    return start / (exponent - 1) * ((start / chamber) ** (exponent - 1) - 1)
