"""Exact expressions as people write them in a robot file: ``q3 + pi/2``, ``-d4``, ``76725/152``, ``1.300 m``.

The grammar, precedence as in Python: numbers (``1.300`` is 13/10), ``pi``, names, ``+ - * /``, ``^`` or ``**`` with an
integer exponent, parentheses, signs. Nothing is ever evaluated as code, and every size is bounded.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import sympy

from generator.errors import NOWHERE, InputError, Place
from generator.units import Quantity, accepted, is_unit, parse_unit

#: Bounds that no honest robot file meets, so that no input can cost more than an instant.
_MAX_LENGTH = 500
_MAX_DEPTH = 32
_MAX_EXPONENT = 64
_MAX_BITS = 4096
_MAX_TERMS = 1000

_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[A-Za-z_]\w*)|(?P<operator>\*\*|[-+*/^()]))",
    re.ASCII,
)
_NOT_FINITE = re.compile(r"\.?(?:inf|infinity|nan)\Z", re.IGNORECASE)
#: The unit of a pure number, written behind it.
_ONE = re.compile(r"(?:(?<=[\d.)])|(?<=pi))\s+1\s*\Z")
_GRAMMAR = "numbers, pi, names and + - * / ^ ( )"
_POINT = f"{_GRAMMAR}; decimals stand after a point"
_END = "an operator or the end"
_NO_UNIT = f"{_END}; a unit stands behind a number alone: write pi/2, or give it a name in geometry"
_OPERAND = "a number, pi, a name or ("


@dataclass(frozen=True)
class _Token:
    kind: str
    text: str
    place: Place


def parse(text: str, place: Place) -> sympy.Expr:
    """The exact expression that ``text`` says; names become real sympy symbols, ``pi`` the number.

    ``place`` is where ``text`` starts. Raises InputError, at the exact column, for anything outside the grammar, a
    division by zero, and what is too long, too deep or too large.
    """
    return _Parser(_tokens(text, place)).expression()


def parse_number(text: str, place: Place) -> sympy.Expr:
    """The exact constant that ``text`` says. Raises InputError, also for a name and for what a float cannot hold."""
    tokens = _tokens(text, place)
    for token in tokens:
        if token.kind == "name" and token.text != "pi":
            raise InputError(token.place, f"{token.text!r} is not a number", "numbers, pi and + - * / ^ ( )")
    # sympy sees that (pi + 1) (pi - 1) - pi^2 + 1 is zero only where it is expanded.
    return _finite(sympy.expand(_Parser(tokens).expression()), place)


def parse_quantity(text: str, unit: str | None, place: Place) -> Quantity:
    """A constant with its unit, such as ``1.300 m``, ``-90 deg`` or ``pi/2 rad``, converted to SI exactly.

    ``unit`` is the SI unit that must be measured; None takes any, and a plain number too, whose unit is "1". ``place``
    is where ``text`` starts. Raises InputError for a missing, unknown or wrong unit and as ``parse_number`` does.
    """
    number, unit_text, unit_place = _split(text, place)
    example = accepted(unit) if unit else "a number with its unit"
    if not number.strip():
        what = f"no number before {unit_text!r}" if unit_text else "the value is empty"
        raise InputError(place, what, f"a number in {example}" if unit else example)
    if not unit_text and unit in (None, "1"):
        number = _ONE.sub("", number)
    value = parse_number(number, place)
    if not unit_text:
        if unit is None:
            return Quantity(value, "1", place)
        if unit != "1":
            raise InputError(place, f"no unit after {number.strip()!r}", example)
        return Quantity(value, "1", place)
    read = parse_unit(unit_text, unit_place, unit)
    return Quantity(_finite(value * read.factor, place), read.si, place)


def has_unit(text: str) -> bool:
    """Whether ``text`` is a number with a unit behind it, which an expression over names never looks like.

    The unit of a pure number is 1: ``0.1 1``.
    """
    try:
        number, unit, _ = _split(text, NOWHERE)
    except InputError:
        return False
    return bool(re.search(r"(?:[\d.)]|pi)\s*\Z", number) if unit else _ONE.search(number))


def _split(text: str, place: Place) -> tuple[str, str, Place]:
    """The expression and the unit, which starts at the first name that is not pi."""
    _check_length(text, place)
    offset = 0
    while match := _TOKEN.match(text, offset):
        if match.lastgroup == "name" and match["name"] != "pi":
            start = match.start("name")
            _check_name(text, start, match["name"], place)
            return text[:start], text[start:].strip(), _at(place, start)
        offset = match.end()
    return text, "", place


def _tokens(text: str, place: Place) -> list[_Token]:
    _check_length(text, place)
    tokens: list[_Token] = []
    offset = 0
    while match := _TOKEN.match(text, offset):
        kind = match.lastgroup or ""
        start = match.start(kind)
        if kind == "name":
            _check_name(text, start, match[kind], place)
        tokens.append(_Token(kind, match[kind], _at(place, start)))
        offset = match.end()
    rest = text[offset:].lstrip()
    start = len(text) - len(rest)
    if word := re.match(r"\.?\w+", rest):
        _check_name(text, start, word[0], place)
    if rest:
        raise InputError(_at(place, start), f"unexpected {rest[0]!r}", _POINT if rest[0] == "," else _GRAMMAR)
    return [*tokens, _Token("end", "", _at(place, len(text.rstrip())))]


def _check_length(text: str, place: Place) -> None:
    if len(text) > _MAX_LENGTH:
        raise InputError(place, f"an expression of {len(text)} characters", f"at most {_MAX_LENGTH}")


def _check_name(text: str, start: int, name: str, place: Place) -> None:
    if text[start + len(name) :].lstrip().startswith("("):
        raise InputError(_at(place, start), f"a call of {name!r}", _GRAMMAR)
    if _NOT_FINITE.match(name):
        raise InputError(_at(place, start), f"{name!r} is not a finite number", "a finite number")


def _at(place: Place, offset: int) -> Place:
    return replace(place, column=place.column + offset)


def _finite(value: sympy.Expr, place: Place) -> sympy.Expr:
    if not is_finite(value):
        raise InputError(place, "the number is too large", "a finite number")
    return value


class _Parser:
    """Recursive descent over the tokens of one expression."""

    def __init__(self, tokens: Sequence[_Token]) -> None:
        self._tokens = tokens
        self._next = 0
        self._depth = 0

    def expression(self) -> sympy.Expr:
        result = self._sum()
        token = self._peek()
        if token.kind != "end":
            raise InputError(token.place, f"unexpected {token.text!r}", _NO_UNIT if is_unit(token.text) else _END)
        return result

    def _peek(self) -> _Token:
        return self._tokens[self._next]

    def _take(self, *operators: str) -> _Token | None:
        token = self._peek()
        if token.kind != "operator" or token.text not in operators:
            return None
        self._next += 1
        return token

    def _sum(self) -> sympy.Expr:
        total = self._product()
        while operator := self._take("+", "-"):
            term = self._product()
            total = _bounded(total + term if operator.text == "+" else total - term, operator.place)
        return total

    def _product(self) -> sympy.Expr:
        product = self._signed()
        while operator := self._take("*", "/"):
            factor = self._signed()
            if operator.text == "/":
                factor = _inverse(factor, operator.place)
            product = _bounded(product * factor, operator.place)
        return product

    def _signed(self) -> sympy.Expr:
        negative = False
        while sign := self._take("+", "-"):
            negative ^= sign.text == "-"
        value = self._power()
        return -value if negative else value

    def _power(self) -> sympy.Expr:
        base = self._operand()
        operator = self._take("^", "**")
        if operator is None:
            return base
        self._descend(operator.place)
        exponent = self._signed()
        self._depth -= 1
        return _power(base, exponent, operator.place)

    def _operand(self) -> sympy.Expr:
        token = self._peek()
        self._next += 1
        if token.kind == "number":
            return _number(token)
        if token.kind == "name":
            return sympy.pi if token.text == "pi" else sympy.Symbol(token.text, real=True)
        if token.text != "(":
            problem = f"unexpected {token.text!r}" if token.text else "the expression ends too early"
            raise InputError(token.place, problem, _OPERAND)
        self._descend(token.place)
        inner = self._sum()
        self._depth -= 1
        if self._take(")") is None:
            raise InputError(token.place, "unclosed parenthesis", "as many ) as (")
        return inner

    def _descend(self, place: Place) -> None:
        self._depth += 1
        if self._depth > _MAX_DEPTH:
            raise InputError(place, "the expression is nested too deeply", f"at most {_MAX_DEPTH} levels")


def _number(token: _Token) -> sympy.Expr:
    mantissa, _, exponent = token.text.lower().partition("e")
    if len(exponent) > 4 or abs(int(exponent or 0)) > 300:
        raise InputError(token.place, f"{token.text!r} is not a finite number", "a size from 1e-300 to 1e300")
    return sympy.Rational(mantissa) * sympy.Integer(10) ** int(exponent or 0)


def _bounded(value: sympy.Expr, place: Place) -> sympy.Expr:
    """``value`` unless its exact fraction has grown beyond bounds, or what it is when it is written out."""
    if _bits(value) > _MAX_BITS:
        raise InputError(place, "the exact fraction grows too large", f"at most {_MAX_BITS} bits")
    if _terms(value) > _MAX_TERMS:
        raise InputError(place, "the expression grows too large", f"at most {_MAX_TERMS} terms when it is written out")
    return value


def _terms(value: sympy.Expr) -> int:
    """At most how many terms ``value`` has when its products and powers are written out."""
    if value.is_Pow and value.exp.is_Integer:
        base, exponent = _terms(value.base), abs(int(value.exp))
        return math.comb(base - 1 + exponent, exponent)
    parts = [_terms(part) for part in value.args]
    return sum(parts) if value.is_Add else math.prod(parts)


def _bits(value: sympy.Expr) -> int:
    return max((max(int(r.p).bit_length(), int(r.q).bit_length()) for r in value.atoms(sympy.Rational)), default=0)


def _inverse(value: sympy.Expr, place: Place) -> sympy.Expr:
    if vanishes(value):
        raise InputError(place, "division by zero", "a divisor that is not zero")
    return 1 / value


def is_finite(constant: sympy.Expr) -> bool:
    """Whether ``constant`` is a real number that a float can hold."""
    if constant.has(sympy.zoo, sympy.nan, sympy.oo):
        return False
    try:
        return math.isfinite(float(constant))
    except OverflowError:
        return False


def vanishes(value: sympy.Expr) -> bool:
    """Whether ``value`` is zero whatever its names stand for, also where sympy has not simplified it to 0.

    Decided at one generic rational point, where the value is exact or known to thirty digits.
    """
    generic = {
        symbol: sympy.Rational(1009 + 2 * index, 1013 + 4 * index)
        for index, symbol in enumerate(sorted(value.free_symbols, key=str))
    }
    return _is_zero(value.subs(generic))


def _is_zero(constant: sympy.Expr) -> bool:
    if constant.is_Mul:
        return any(_is_zero(factor) for factor in constant.args)
    if constant.is_Pow:
        return _is_zero(constant.base)
    if constant.is_Add:
        largest = max(abs(term.evalf(30)) for term in constant.args)
        return bool(abs(constant.evalf(30)) < largest * sympy.Float("1e-60"))
    return bool(constant == 0) or constant.has(sympy.zoo, sympy.nan)


def _power(base: sympy.Expr, exponent: sympy.Expr, place: Place) -> sympy.Expr:
    if not exponent.is_Integer:
        raise InputError(place, f"the exponent is {exponent}", "an integer")
    nested = max((abs(power.exp) for power in base.atoms(sympy.Pow)), default=1)
    if nested * abs(exponent) > _MAX_EXPONENT or _bits(base) * abs(exponent) > _MAX_BITS:
        raise InputError(place, "the power grows too large", f"exponents up to {_MAX_EXPONENT} altogether")
    if exponent < 0 and vanishes(base):
        raise InputError(place, "division by zero", "a divisor that is not zero")
    return _bounded(base**exponent, place)
