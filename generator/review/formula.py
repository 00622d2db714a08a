"""A formula as a reviewer reads it: sympy's tree put in reading order once, for every notation to print.

Ratios are one fraction, minus signs stand in front, sums start with a positive term, names follow in natural order
(``d2`` before ``d10``). The printers ``plain``, ``tex`` and ``mathml`` walk this tree and decide nothing but notation.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

import sympy

from generator.review.decimals import terminates
from generator.review.trigonometry import without_half_angles

#: Stems that are printed as letters of another alphabet, in every notation that has them.
GREEK = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "delta": "δ",
    "epsilon": "ε",
    "theta": "θ",
    "lambda": "λ",
    "mu": "μ",
    "nu": "ν",
    "rho": "ρ",
    "sigma": "σ",
    "tau": "τ",
    "phi": "φ",
    "psi": "ψ",
    "omega": "ω",
    "pi": "π",
}

#: Stems of time derivatives: the letter and its number of dots.
DOTTED = {"qd": ("q", 1), "qdd": ("q", 2)}

#: What rounding leaves of numbers that are carried to sixty digits.
_ROUNDING = Fraction(1, 10**50)
_NAME = re.compile(r"([A-Za-z]+)_?(.*)", re.DOTALL)


@dataclass(frozen=True)
class Number:
    """A non-negative exact number."""

    value: Fraction


@dataclass(frozen=True)
class Name:
    """A name such as ``ZZ1R`` or ``rl4``: a stem and what stands below it."""

    text: str

    @property
    def parts(self) -> tuple[str, str]:
        """Stem and subscript: ``("ZZ", "1R")``, ``("rl", "4")``, ``("phi", "")``."""
        match = _NAME.fullmatch(self.text)
        return (match.group(1), match.group(2)) if match else (self.text, "")


@dataclass(frozen=True)
class Negative:
    """Minus the body."""

    body: Formula


@dataclass(frozen=True)
class Power:
    """Base to an exponent; the square root is a ``Call`` of ``sqrt``."""

    base: Formula
    exponent: Formula


@dataclass(frozen=True)
class Call:
    """A function of one argument, or of the several in ``Arguments``."""

    function: str
    argument: Formula


@dataclass(frozen=True)
class Arguments:
    """Several arguments of a ``Call``."""

    items: tuple[Formula, ...]


@dataclass(frozen=True)
class Quotient:
    """A fraction."""

    above: Formula
    below: Formula


@dataclass(frozen=True)
class Product:
    """At least two factors."""

    factors: tuple[Formula, ...]


@dataclass(frozen=True)
class Sum:
    """At least two terms; a negative one is a ``Negative``."""

    terms: tuple[Formula, ...]


@dataclass(frozen=True)
class Equation:
    """Two sides with an equals sign between them."""

    left: Formula
    right: Formula


Formula: TypeAlias = Number | Name | Negative | Power | Call | Arguments | Quotient | Product | Sum | Equation

ONE = Number(Fraction(1))


def formula(expression: sympy.Expr) -> Formula:
    """The formula of an exact expression; nothing is expanded, factored or evaluated."""
    if expression.is_Rational:
        value = Fraction(int(expression.p), int(expression.q))
        return Negative(_number(-value)) if value < 0 else _number(value)
    if isinstance(expression, sympy.Symbol):
        return Name(expression.name)
    if isinstance(expression, sympy.Add):
        return total(formula(term) for term in sorted(expression.args, key=_reading_order))
    if isinstance(expression, sympy.Mul):
        return _product(expression)
    if isinstance(expression, sympy.Pow):
        return _power(expression)
    if isinstance(expression, (sympy.NumberSymbol, sympy.Float)):
        return Name(str(expression))
    return Call(expression.func.__name__.lower(), formula(expression.args[0]))


def polynomial(expression: sympy.Expr) -> Formula:
    """The formula of an expression multiplied out: ``d2^2 + d3^2``, ``2 rl4``, never nested."""
    return formula(sympy.expand(without_half_angles(expression)))


def total(terms: Iterable[Formula]) -> Formula:
    """The sum of formulas in the order given, zeros left out."""
    kept = tuple(term for term in terms if term != Number(Fraction(0)))
    if not kept:
        return Number(Fraction(0))
    return kept[0] if len(kept) == 1 else Sum(kept)


def times(*factors: Formula) -> Formula:
    """The product of formulas in the order given: signs moved out, ones left out."""
    negative = False
    kept: list[Formula] = []
    for factor in factors:
        if isinstance(factor, Negative):
            negative, factor = not negative, factor.body
        elif isinstance(factor, Sum) and all(isinstance(term, Negative) for term in factor.terms):
            negative, factor = not negative, Sum(tuple(t.body for t in factor.terms if isinstance(t, Negative)))
        if isinstance(factor, Product):
            kept += factor.factors
        elif factor != ONE:
            kept.append(factor)
    body: Formula = ONE if not kept else kept[0] if len(kept) == 1 else Product(tuple(kept))
    return Negative(body) if negative else body


def natural(text: str) -> tuple[tuple[int, int, str], ...]:
    """Sorting key that counts numbers inside names: ``d2`` comes before ``d10``."""
    return tuple((1, int(part), "") if part.isdigit() else (0, 0, part) for part in re.split(r"(\d+)", text) if part)


def _number(value: Fraction) -> Formula:
    """A non-negative number: decimal when it ends and is not a half or a quarter, else a fraction.

    One is what irrational numbers, carried to sixty digits, make up to the last of them.
    """
    if abs(value - 1) < _ROUNDING:
        return ONE
    if value.denominator == 1 or (terminates(value) and value.denominator > 4):
        return Number(value)
    return Quotient(Number(Fraction(value.numerator)), Number(Fraction(value.denominator)))


def _product(product: sympy.Mul) -> Formula:
    coefficient, factors = product.as_coeff_mul()
    size = Fraction(int(coefficient.p), int(coefficient.q)) if coefficient.is_Rational else Fraction(1)
    number = _number(abs(size))
    above: list[Formula] = [number.above if isinstance(number, Quotient) else number]
    below: list[Formula] = [number.below] if isinstance(number, Quotient) else []
    if not coefficient.is_Rational:
        factors = (coefficient, *factors)
    for factor in sorted(factors, key=_factor_order):
        base, exponent = factor.as_base_exp()
        if exponent.is_Rational and exponent < 0:
            below.append(formula(base**-exponent))
        else:
            above.append(formula(factor))
    body = Quotient(times(*above), times(*below)) if below else times(*above)
    return Negative(body) if size < 0 else body


def _power(power: sympy.Pow) -> Formula:
    base, exponent = power.as_base_exp()
    if exponent.is_Rational and exponent < 0:
        return Quotient(ONE, formula(base**-exponent))
    if exponent == sympy.Rational(1, 2):
        return Call("sqrt", formula(base))
    return Power(formula(base), formula(exponent))


def _reading_order(expression: sympy.Expr) -> tuple[object, ...]:
    """Positive before negative, plain factors before functions, higher degree first, then natural order of names."""
    names = sorted((symbol.name for symbol in expression.free_symbols), key=natural)
    functions = bool(names) and any(isinstance(node, sympy.Function) for node in sympy.preorder_traversal(expression))
    nested = isinstance(expression, sympy.Add)
    return (
        functions,
        nested,
        bool(expression.could_extract_minus_sign()) and not nested,
        not names and not expression.is_Rational and not isinstance(expression, sympy.NumberSymbol),
        -_degree(expression),
        tuple(natural(name) for name in names),
        str(expression),
    )


def _factor_order(expression: sympy.Expr) -> tuple[object, ...]:
    """Constants such as pi and roots of numbers first, then as in a sum but without regard to the degree."""
    functions, nested, *_, names, text = _reading_order(expression)
    return (bool(names), functions, nested, names, text)


def _degree(expression: sympy.Expr) -> int:
    """Total degree in the names, functions and roots counted as nothing."""
    if isinstance(expression, sympy.Symbol):
        return 1
    if isinstance(expression, sympy.Mul):
        return sum(_degree(factor) for factor in expression.args)
    if isinstance(expression, sympy.Pow) and expression.exp.is_Integer:
        return int(expression.exp) * _degree(expression.base)
    return 0
