"""Entries of a joint's row: expressions over lengths, of the right dimension, with or without the joint's variable."""

from __future__ import annotations

import re
from collections.abc import Mapping

import sympy

from generator import expressions
from generator.errors import InputError, Place
from generator.robot import fields, rounding
from generator.robot.description import Length
from generator.robot.document import Node, Text
from generator.units import accepted

_VARIABLE = re.compile(r"q\d+\Z", re.ASCII)
_INSTEAD = {"m": "lengths of the geometry", "rad": "multiples of pi and angles of the geometry"}


def constant(node: Node, what: str, unit: str, lengths: Mapping[str, Length]) -> sympy.Expr:
    """An angle [rad] or length [m]: an expression over the geometry's names, or a number with its unit.

    Raises InputError for an undefined name, a joint variable, another dimension, a value that is not finite or too
    large (``fields.check_size``), and one that is rounded (``rounding``).
    """
    scalar = fields.text(node, what, "an expression")
    if expressions.has_unit(scalar.content):
        value = fields.quantity(scalar, what, unit).value
        _check_size(scalar.place, what, value, unit)
        return value
    value = fields.expression(scalar, what)
    for name in sorted(map(str, value.free_symbols)):
        if _VARIABLE.match(name):
            raise InputError(_place_of(name, scalar), f"{what} contains {name}", "no joint variable")
    _check_names(value, scalar, lengths)
    _check_dimension(value, scalar, what, unit, lengths)
    return value


def sum_with_variable(node: Node, what: str, unit: str, lengths: Mapping[str, Length], variable: str) -> sympy.Expr:
    """The joint's variable, with or without a constant added: ``q3``, ``q3 + pi/2``."""
    scalar = fields.text(node, what, f"{variable} + constant")
    value = fields.expression(scalar, what)
    offset = value - sympy.Symbol(variable, real=True)
    _check_names(offset, scalar, lengths)
    if any(_VARIABLE.match(symbol.name) for symbol in offset.free_symbols):
        raise InputError(scalar.place, f"{what} is {scalar.content!r}", f"{variable} + constant")
    _check_dimension(offset, scalar, what, unit, lengths)
    return value


def _check_names(value: sympy.Expr, scalar: Text, lengths: Mapping[str, Length]) -> None:
    for name in sorted(symbol.name for symbol in value.free_symbols):
        if name not in lengths and not _VARIABLE.match(name):
            expected = fields.nearest(name, lengths) if lengths else "a name from geometry"
            raise InputError(_place_of(name, scalar), f"undefined length {name!r}", expected)


def _check_dimension(value: sympy.Expr, scalar: Text, what: str, unit: str, lengths: Mapping[str, Length]) -> None:
    """A length is of degree one in the lengths; an angle in pi and the angles, and of degree zero in the lengths."""
    metres = [sympy.Symbol(name, real=True) for name, length in lengths.items() if length.unit == "m"]
    turns = [sympy.pi, *(sympy.Symbol(name, real=True) for name, length in lengths.items() if length.unit == "rad")]
    right = _degree_one(value, metres) if unit == "m" else _degree_one(value, turns) and _degree_zero(value, metres)
    if not right:
        kind = "length" if unit == "m" else "angle"
        problem = f"{what} has no unit" if value.is_Rational else f"{what} is not {'a' if unit == 'm' else 'an'} {kind}"
        raise InputError(scalar.place, problem, f"{_INSTEAD[unit]}, or a number in {accepted(unit)}")
    nominal = value.xreplace({sympy.Symbol(name, real=True): length.value for name, length in lengths.items()})
    if not expressions.is_finite(nominal):
        raise InputError(scalar.place, f"{what} is not finite for the lengths given", "a finite value")
    _check_size(scalar.place, what, nominal, unit)


def _check_size(place: Place, what: str, value: sympy.Expr, unit: str) -> None:
    fields.check_size(place, what, value, any_small=True)
    (rounding.check_length if unit == "m" else rounding.check_angle)(place, what, value)


def _degree_one(value: sympy.Expr, scaled: list[sympy.Expr]) -> bool:
    return expressions.vanishes(value.xreplace({one: 3 * one for one in scaled}) - 3 * value)


def _degree_zero(value: sympy.Expr, scaled: list[sympy.Expr]) -> bool:
    return expressions.vanishes(value.xreplace({one: 3 * one for one in scaled}) - value)


def _place_of(name: str, scalar: Text) -> Place:
    """Where ``name`` stands in the text, where columns match; else where the text starts."""
    found = re.search(rf"\b{re.escape(name)}\b", scalar.content)
    if scalar.inside is None or found is None:
        return scalar.place
    return Place(scalar.place.file, scalar.inside.line, scalar.inside.column + found.start())
