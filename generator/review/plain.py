"""Formulas as plain text: ``(d2^2 + d3^2) M3``, ``sqrt(d21^2 + 2 d21 d22 cos(phi + q2))``."""

from __future__ import annotations

from generator.review.decimals import decimal
from generator.review.formula import (
    Arguments,
    Call,
    Equation,
    Formula,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
)


def plain(formula: Formula) -> str:
    """One line of text; products by a space, powers by ``^``."""
    if isinstance(formula, Number):
        return decimal(formula.value)
    if isinstance(formula, Name):
        return formula.text
    if isinstance(formula, Negative):
        return f"-{_factor(formula.body)}"
    if isinstance(formula, Power):
        return f"{_atom(formula.base)}^{_atom(formula.exponent)}"
    if isinstance(formula, Call):
        return f"{formula.function}({plain(formula.argument)})"
    if isinstance(formula, Arguments):
        return ", ".join(plain(item) for item in formula.items)
    if isinstance(formula, Quotient):
        return f"{_factor(formula.above)}/{_atom(formula.below)}"
    if isinstance(formula, Product):
        return " ".join(_factor(factor) for factor in formula.factors)
    if isinstance(formula, Equation):
        return f"{plain(formula.left)} = {plain(formula.right)}"
    return _sum(formula)


def _sum(formula: Sum) -> str:
    text = plain(formula.terms[0])
    for term in formula.terms[1:]:
        text += f" - {_factor(term.body)}" if isinstance(term, Negative) else f" + {plain(term)}"
    return text


def _factor(formula: Formula) -> str:
    return f"({plain(formula)})" if isinstance(formula, (Sum, Negative)) else plain(formula)


def _atom(formula: Formula) -> str:
    bare = isinstance(formula, (Number, Name, Call))
    return plain(formula) if bare else f"({plain(formula)})"
