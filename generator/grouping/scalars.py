"""Exact numbers of one robot that remember how they are written in its lengths.

Whether a number is zero is decided at the robot's own lengths (a length that happens to vanish, or two that cancel,
count); what is printed is the symbol. The two are carried together through every operation.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import sympy
from sympy.polys.domains import QQ
from sympy.polys.fields import field

from generator.constants import exact_constant
from generator.robot.description import FIXED, REVOLUTE, Joint, Robot

#: General angles up to which groupings are written in their half tangents, all of them or those that have names beside
#: others that are numbers; fractions in more of them have no end.
_WRITTEN, _NAMED = 2, 1
#: Irrational constants are carried to sixty digits; what is smaller than this is zero.
_NOTHING = Fraction(1, 10**40)


@dataclass(frozen=True)
class Scalar:
    """A number: ``symbol`` in the field of rational functions of the lengths, ``value`` at the robot's lengths."""

    symbol: Any
    value: Fraction

    def __add__(self, other: Scalar) -> Scalar:
        if not self.symbol or not other.symbol:
            return self if self.symbol else other
        return _settled(self.symbol + other.symbol, self.value + other.value)

    def __sub__(self, other: Scalar) -> Scalar:
        if not other.symbol:
            return self
        return _settled(self.symbol - other.symbol, self.value - other.value)

    def __mul__(self, other: Scalar) -> Scalar:
        if not self.value or not other.value:
            return self if not self.value else other
        # Most factors are one, and a product of fractions looks for what cancels.
        if self.symbol == 1 or other.symbol == 1:
            return other if self.symbol == 1 else self
        return Scalar(self.symbol * other.symbol, self.value * other.value)

    def __truediv__(self, other: Scalar) -> Scalar:
        if other.symbol == 1:
            return self
        return Scalar(self.symbol / other.symbol, self.value / other.value)

    def __neg__(self) -> Scalar:
        return Scalar(-self.symbol, -self.value)

    def __bool__(self) -> bool:
        return bool(self.value)


def _settled(symbol: Any, value: Fraction) -> Scalar:
    if value and abs(value) < _NOTHING:
        value = Fraction(0)
    return Scalar(symbol, value) if value else Scalar(symbol * 0, value)


class Numbers:
    """The field of one robot: makes scalars from its expressions and writes them back."""

    def __init__(self, robot: Robot) -> None:
        self._values = robot.geometry
        self._constant = robot.constant_angles
        self._half_tangents = _half_tangents(robot)
        names = [str(symbol) for symbol in self._values] + [str(symbol) for symbol in self._half_tangents.values()]
        self._field: Any = field(names or ["_"], QQ)[0]
        self._generators = dict(zip(names, self._field.gens, strict=False))
        self.zero = Scalar(self._field.zero, Fraction(0))
        self.one = Scalar(self._field.one, Fraction(1))

    def integer(self, value: int) -> Scalar:
        """The scalar of an integer."""
        if value in (0, 1):
            return self.one if value else self.zero
        return Scalar(self._field(value), Fraction(value))

    def length(self, expression: sympy.Expr) -> Scalar:
        """A rational expression of the lengths."""
        value = exact_constant(expression.xreplace(self._values))
        if not value:
            return self.zero
        return Scalar(self._rational(expression), value)

    def constant(self, expression: sympy.Expr) -> Scalar:
        """A number of the robot that is not written in lengths (gravity), irrational ones to sixty digits."""
        value = exact_constant(expression)
        return Scalar(self._field(QQ(value.numerator, value.denominator)), value) if value else self.zero

    def cosine_sine(self, angle: sympy.Expr) -> tuple[Scalar, Scalar]:
        """Cosine and sine of a constant angle: exact at quarter turns, else through the half angle's tangent, or as
        numbers where the robot has many such angles.
        """
        quarters, rest = _quarters(angle, self._constant)
        cosine, sine = self._of(rest) if rest else (self.one, self.zero)
        return ((cosine, sine), (-sine, cosine), (-cosine, -sine), (sine, -cosine))[quarters]

    def _of(self, angle: sympy.Expr) -> tuple[Scalar, Scalar]:
        """The same of an angle that is no quarter turn."""
        positive, sign = _unsigned(angle)
        if positive not in self._half_tangents:
            at = angle.xreplace(self._values)
            return self.constant(sympy.cos(at)), self.constant(sympy.sin(at))
        t = self._generators[str(self._half_tangents[positive])]
        at = positive.subs(self._values)
        cosine = _settled((1 - t**2) / (1 + t**2), exact_constant(sympy.cos(at)))
        sine = _settled(2 * t / (1 + t**2), exact_constant(sympy.sin(at)))
        return cosine, sine if sign > 0 else -sine

    def expression(self, scalar: Scalar) -> sympy.Expr:
        """The scalar as it is read: expanded in the lengths, half-angle tangents written as the angles they are."""
        if not scalar:
            return sympy.Integer(0)
        result = scalar.symbol.as_expr()
        renamed = {sympy.Symbol(str(symbol)): symbol for symbol in self._values}
        tangents = {sympy.Symbol(str(t)): sympy.tan(angle / 2) for angle, t in self._half_tangents.items()}
        return result.subs(tangents).subs(renamed)

    def _rational(self, expression: sympy.Expr) -> Any:
        if expression.is_Symbol:
            return self._generators[str(expression)]
        if not expression.free_symbols:
            value = exact_constant(expression)
            return self._field(QQ(value.numerator, value.denominator))
        parts = [self._rational(argument) for argument in expression.args]
        if expression.is_Add:
            return sum(parts[1:], parts[0])
        if expression.is_Mul:
            product = parts[0]
            for part in parts[1:]:
                product = product * part
            return product
        if expression.is_Pow and expression.exp.is_Integer:
            return parts[0] ** int(expression.exp)
        raise ValueError(f"a length must be a rational expression of named lengths, got {expression}")


def _half_tangents(robot: Robot) -> dict[sympy.Expr, sympy.Symbol]:
    """A symbol for tan(angle/2) of each constant angle of the geometry that is no quarter turn, of which no length can
    have the name. Where there are too many, of angles with named lengths alone, and where those are too many, of
    symbolic ones alone.
    """
    symbolic = {sympy.Symbol(length.name, real=True) for length in robot.lengths if length.symbolic}
    angles: dict[sympy.Expr, sympy.Symbol] = {}
    for angle in _constant_angles(robot):
        _, rest = _quarters(angle, robot.constant_angles)
        if rest:
            positive, _ = _unsigned(rest)
            angles.setdefault(positive, sympy.Symbol(f"_tan_half_{len(angles)}"))
    named = {angle: symbol for angle, symbol in angles.items() if angle.free_symbols}
    for written, most in ((angles, _WRITTEN), (named, _NAMED)):
        if len(written) <= most:
            return written
    return {angle: symbol for angle, symbol in named.items() if angle.free_symbols & symbolic}


def _constant_angles(robot: Robot) -> list[sympy.Expr]:
    angles = []
    for joint in robot.joints:
        angles += [joint.alpha, joint.gamma]
        if joint.sigma != REVOLUTE:
            angles.append(joint.theta)
    return angles


def _quarters(angle: sympy.Expr, constant: Mapping[sympy.Symbol, sympy.Expr]) -> tuple[int, sympy.Expr]:
    """Quarter turns of an angle, 0 to 3, and what is left beside them; ``constant`` angles may be some."""
    turns = 2 * angle.xreplace(constant) / sympy.pi
    if turns.is_Integer:
        return int(turns) % 4, sympy.Integer(0)
    beside, named = angle.as_independent(*angle.free_symbols, as_Add=True) if angle.free_symbols else (0, angle)
    turns = 2 * sympy.sympify(beside) / sympy.pi
    return (int(turns) % 4, named) if turns.is_Integer else (0, angle)


def _unsigned(angle: sympy.Expr) -> tuple[sympy.Expr, int]:
    return (-angle, -1) if angle.could_extract_minus_sign() else (angle, 1)


def fixed_angle(joint: Joint) -> sympy.Expr:
    """theta of a joint that does not turn, zero of one that does: grouping may choose any angle of a turning joint."""
    return sympy.Integer(0) if joint.sigma == REVOLUTE else joint.theta


def fixed_shift(joint: Joint) -> sympy.Expr:
    """r of a joint that does not slide, zero of one that does."""
    return joint.r if joint.sigma in (REVOLUTE, FIXED) else sympy.Integer(0)
