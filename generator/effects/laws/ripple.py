"""A torque that repeats with a turning part, Rc cos(phase) + Rs sin(phase) + R2c cos(2 phase) + R2s sin(2 phase), and
the energy that it swings with. Nothing that turns is so true that it has no second harmonic.
"""

from __future__ import annotations

import sympy

from generator.effects.effect import LinearParameter, Shape


def parameters(stem: str, units: tuple[str, str], what: str) -> tuple[LinearParameter, ...]:
    """The four parts of ``what``: ``stem`` with c and s, and with 2c and 2s, which refine them."""
    return (
        LinearParameter(f"{stem}c", units, f"cosine part of {what}"),
        LinearParameter(f"{stem}s", units, f"sine part of {what}"),
        LinearParameter(f"{stem}2c", units, "cosine part of its second harmonic", refines=True),
        LinearParameter(f"{stem}2s", units, "sine part of its second harmonic", refines=True),
    )


def order(part: str, tried: tuple[float, ...], default: int | None = None, several: int = 0) -> Shape:
    """Periods per turn of a ``part``: a whole number of lobes, poles or waves. ``tried``, ``several`` as in Shape."""
    whole = None if default is None else sympy.Integer(default)
    what = f"periods per turn of the {part}"
    return Shape("order", "1", what, lower=0.0, default=whole, tried=tried, whole=True, several=several, exact=True)


def torque_columns(phase: sympy.Expr) -> tuple[sympy.Expr, ...]:
    """Torque per unit of each part."""
    cosine, sine = sympy.cos(phase), sympy.sin(phase)
    return cosine, sine, 2 * cosine**2 - 1, 2 * cosine * sine


def energy_columns(phase: sympy.Expr, slope: sympy.Expr) -> tuple[sympy.Expr, ...]:
    """Energy per unit of each part, zero at phase 0; ``slope`` is the phase per position of the joint."""
    cosine, sine = sympy.cos(phase), sympy.sin(phase)
    return sine / slope, (1 - cosine) / slope, cosine * sine / slope, sine**2 / slope
