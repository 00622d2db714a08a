r"""Formulas in LaTeX's mathematics: ``\left(d_{2}^{2} + d_{3}^{2}\right) M_{3}``."""

from __future__ import annotations

from generator.review.decimals import decimal
from generator.review.formula import (
    DOTTED,
    GREEK,
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

_LITERAL = str.maketrans(
    {c: f"\\{c}" for c in "&%$#_{}"}
    | {"~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "\\": r"\textbackslash{}"}
)

_OPERATORS = {name: rf"\{name}" for name in ("sin", "cos", "log", "exp", "tanh")}


def tex(formula: Formula) -> str:
    """Text for mathematics mode; needs nothing but amsmath."""
    if isinstance(formula, Number):
        return decimal(formula.value)
    if isinstance(formula, Name):
        return _name(formula)
    if isinstance(formula, Negative):
        return f"-{_factor(formula.body)}"
    if isinstance(formula, Power):
        base = tex(formula.base)
        bare = isinstance(formula.base, Name) or (isinstance(formula.base, Number) and len(base) == 1)
        return f"{base if bare else _parenthesis(base)}^{{{tex(formula.exponent)}}}"
    if isinstance(formula, Call):
        return _call(formula)
    if isinstance(formula, Arguments):
        return ", ".join(tex(item) for item in formula.items)
    if isinstance(formula, Quotient):
        return rf"\frac{{{tex(formula.above)}}}{{{tex(formula.below)}}}"
    if isinstance(formula, Product):
        return r" \, ".join(_factor(factor) for factor in formula.factors)
    if isinstance(formula, Equation):
        return f"{tex(formula.left)} = {tex(formula.right)}"
    return "".join(terms(formula))


def terms(formula: Formula) -> list[str]:
    """The pieces of a sum with their signs, so that a long one can be broken between them."""
    if not isinstance(formula, Sum):
        return [tex(formula)]
    pieces = [tex(formula.terms[0])]
    for term in formula.terms[1:]:
        pieces.append(f" - {_factor(term.body)}" if isinstance(term, Negative) else f" + {tex(term)}")
    return pieces


def escape(text: str) -> str:
    """Text outside mathematics mode, with LaTeX's own characters taken literally."""
    return text.translate(_LITERAL)


def _name(name: Name) -> str:
    stem, below = name.parts
    letter, dots = DOTTED.get(stem, (stem, 0))
    if letter in GREEK:
        letter = f"\\{letter}"
    elif len(letter) > 1:
        letter = rf"\mathit{{{letter}}}"
    if dots:
        letter = rf"\{'d' * dots}ot{{{letter}}}"
    return f"{letter}_{{{escape(below)}}}" if below else letter


def _call(call: Call) -> str:
    argument = tex(call.argument)
    if call.function == "sqrt":
        return rf"\sqrt{{{argument}}}"
    if call.function == "abs":
        return rf"\left|{argument}\right|"
    return _OPERATORS.get(call.function, rf"\operatorname{{{call.function}}}") + _parenthesis(argument)


def _factor(formula: Formula) -> str:
    return _parenthesis(tex(formula)) if isinstance(formula, (Sum, Negative)) else tex(formula)


def _parenthesis(text: str) -> str:
    return rf"\left({text}\right)"
