"""Constants as exact fractions."""

from __future__ import annotations

from fractions import Fraction

import sympy

#: Digits kept of an irrational constant; far beyond double precision, so that folding stays exact in print.
_DIGITS = 60


def exact_constant(expression: sympy.Expr) -> Fraction:
    """The fraction of a constant expression: exact if rational, else its value to sixty digits.

    The value does not pass through the machine's floating point, so that it is the same everywhere.
    """
    if expression.is_Rational:
        return Fraction(int(expression.p), int(expression.q))
    simplified = sympy.nsimplify(expression, rational=True) if expression.is_Float else expression
    if simplified.is_Rational:
        return Fraction(int(simplified.p), int(simplified.q))
    value = sympy.N(simplified, _DIGITS)
    if not value.is_real or not value.is_finite:
        raise ValueError(f"{expression} is not a finite real number")
    return Fraction(str(value))
