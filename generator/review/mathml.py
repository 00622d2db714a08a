"""Formulas as MathML, which browsers typeset themselves: no script, no font to fetch."""

from __future__ import annotations

from collections.abc import Sequence

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
from generator.review.markup import Markup, element
from generator.review.plain import plain

#: What is short enough to stand beside a slash instead of under a bar.
_SHORT = (Number, Name)

#: Functions that are set upright.
_OPERATORS = ("sin", "cos", "log", "exp", "tanh", "sign", "diag")


def math(formula: Formula, *, display: bool = False) -> Markup:
    """A ``math`` element; its plain text is kept for readers that typeset nothing."""
    return element("math", mathml(formula), displaystyle="true" if display else None, alttext=plain(formula))


def terms(formula: Formula) -> list[Markup]:
    """The terms of a sum as ``math`` elements of their own, signs included, so that a long sum wraps between them."""
    if not isinstance(formula, Sum):
        return [math(formula)]
    pieces = [math(formula.terms[0])]
    for term in formula.terms[1:]:
        negative = isinstance(term, Negative)
        body = _factor(term.body) if isinstance(term, Negative) else mathml(term)
        sign = element("mo", "−" if negative else "+", form="infix")
        pieces.append(element("math", element("mrow", sign, body), alttext=("" if negative else "+ ") + plain(term)))
    return pieces


def matrix(rows: Sequence[Sequence[Formula]]) -> Markup:
    """The elements of a matrix; its brackets are lines of the style sheet, which need no font that stretches."""
    lines = [element("mtr", [element("mtd", mathml(entry)) for entry in row]) for row in rows]
    return element("mtable", lines, class_="matrix")


def mathml(formula: Formula) -> Markup:
    """The elements of a formula, one ``mrow`` at most around them."""
    if isinstance(formula, Number):
        return element("mn", decimal(formula.value))
    if isinstance(formula, Name):
        return _name(formula)
    if isinstance(formula, Negative):
        return element("mrow", _sign("−"), _factor(formula.body))
    if isinstance(formula, Power):
        if isinstance(formula.base, Name) and formula.base.parts[1]:
            return element("msubsup", *_letter_and_index(formula.base), mathml(formula.exponent))
        bare = isinstance(formula.base, (Number, Name))
        base = mathml(formula.base) if bare else _parenthesis(formula.base)
        return element("msup", base, mathml(formula.exponent))
    if isinstance(formula, Call):
        return _call(formula)
    if isinstance(formula, Arguments):
        comma = element("mo", ",", separator="true")
        return element("mrow", [[comma if k else None, mathml(item)] for k, item in enumerate(formula.items)])
    if isinstance(formula, Quotient):
        if isinstance(formula.above, _SHORT) and isinstance(formula.below, _SHORT):
            return element(
                "mrow", mathml(formula.above), element("mo", "/", lspace="0", rspace="0"), mathml(formula.below)
            )
        return element("mfrac", mathml(formula.above), mathml(formula.below))
    if isinstance(formula, Product):
        return element("mrow", _interleave([_factor(factor) for factor in formula.factors]))
    if isinstance(formula, Equation):
        return element("mrow", mathml(formula.left), element("mo", "="), mathml(formula.right))
    return _sum(formula)


def _sum(formula: Sum) -> Markup:
    pieces = [mathml(formula.terms[0])]
    for term in formula.terms[1:]:
        if isinstance(term, Negative):
            pieces += [element("mo", "−"), _factor(term.body)]
        else:
            pieces += [element("mo", "+"), mathml(term)]
    return element("mrow", pieces)


def _name(name: Name) -> Markup:
    letter, *index = _letter_and_index(name)
    return element("msub", letter, *index) if index else letter


def _letter_and_index(name: Name) -> list[Markup]:
    """The stem, and what stands below it if anything does; dots of derivatives are combining characters."""
    stem, below = name.parts
    letter, dots = DOTTED.get(stem, (stem, 0))
    letter = GREEK.get(letter, letter) + ("", "\u0307", "\u0308")[dots]
    identifier = element("mi", letter, class_="word" if len(letter) > 1 else None)
    return [identifier, element("mn" if below.isdigit() else "mi", below)] if below else [identifier]


def _call(call: Call) -> Markup:
    if call.function == "sqrt":
        return element("msqrt", mathml(call.argument))
    if call.function == "abs":
        bars = [element("mo", "|", stretchy="true", form=form) for form in ("prefix", "postfix")]
        return element("mrow", bars[0], mathml(call.argument), bars[1])
    known = len(call.function) == 1 or call.function in _OPERATORS
    name = element("mi", call.function, class_=None if known else "word")
    return element("mrow", name, element("mo", "\u2061"), _parenthesis(call.argument))


def _interleave(factors: list[Markup]) -> list[Markup]:
    """Factors with a thin space between, wide enough that two names do not read as one."""
    space = element("mspace", width="0.17em")
    return [factors[0], *(piece for factor in factors[1:] for piece in (space, factor))]


def _factor(formula: Formula) -> Markup:
    return _parenthesis(formula) if isinstance(formula, (Sum, Negative)) else mathml(formula)


def _parenthesis(formula: Formula) -> Markup:
    return element("mrow", element("mo", "("), mathml(formula), element("mo", ")"))


def _sign(text: str) -> Markup:
    return element("mo", text, form="prefix")
