"""A linear spring with preload: F = Kr r + K0 (report eq. 19)."""

from __future__ import annotations

import sympy


def force_columns(length: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    """Force per unit of the stiffness Kr [m] and of the preload K0 [1]."""
    return length, sympy.Integer(1)


def energy_columns(length: sympy.Expr, start: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    """Energy per unit of Kr [m2] and K0 [m], zero at the length ``start``."""
    return (length**2 - start**2) / 2, length - start
