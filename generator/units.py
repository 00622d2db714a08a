"""Units of measurement: from the text that a person writes to an exact factor and the SI unit.

A unit is a product of units with integer powers, at most one of them divided by: ``kg m2``, ``N.m.s/rad``,
``mm``, ``m/s^2``. The radian counts as a unit of its own, so that an angle cannot be taken for a plain number.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import sympy

from generator.errors import NOWHERE, InputError, Place

_BASE = ("kg", "m", "s", "A", "K", "rad")

#: The factor to SI and the powers of kg, m, s, A, K, rad.
_SYMBOLS: dict[str, tuple[sympy.Expr, tuple[int, ...]]] = {
    "kg": (sympy.Integer(1), (1, 0, 0, 0, 0, 0)),
    "g": (sympy.Rational(1, 1000), (1, 0, 0, 0, 0, 0)),
    "m": (sympy.Integer(1), (0, 1, 0, 0, 0, 0)),
    "cm": (sympy.Rational(1, 100), (0, 1, 0, 0, 0, 0)),
    "mm": (sympy.Rational(1, 1000), (0, 1, 0, 0, 0, 0)),
    "s": (sympy.Integer(1), (0, 0, 1, 0, 0, 0)),
    "ms": (sympy.Rational(1, 1000), (0, 0, 1, 0, 0, 0)),
    "A": (sympy.Integer(1), (0, 0, 0, 1, 0, 0)),
    "K": (sympy.Integer(1), (0, 0, 0, 0, 1, 0)),
    "rad": (sympy.Integer(1), (0, 0, 0, 0, 0, 1)),
    "mrad": (sympy.Rational(1, 1000), (0, 0, 0, 0, 0, 1)),
    "deg": (sympy.pi / 180, (0, 0, 0, 0, 0, 1)),
    "N": (sympy.Integer(1), (1, 1, -2, 0, 0, 0)),
    "kN": (sympy.Integer(1000), (1, 1, -2, 0, 0, 0)),
}

#: SI units as the field writes them; any other is written in base units.
_CUSTOMARY = (
    "1", "kg", "kg m", "kg m2", "m", "rad", "m/s", "rad/s", "m/s2", "rad/s2", "N", "N m", "N/m", "N m/rad", "N s/m",
    "N m s/rad", "N m/rad3", "N/m3", "N/A", "N m/A", "rad/m", "m/rad",
)  # fmt: skip

_ALTERNATIVES = {"m": "m, cm or mm", "rad": "rad, mrad or deg"}
_FACTOR = re.compile(r"([A-Za-z]+)(?:\^?(-?[1-9]))?\Z")
_PRODUCT = re.compile(r"\s*[*·.]\s*|\s+")
_EXAMPLES = "a unit such as m, rad, kg m2, N m or N m s/rad"


@dataclass(frozen=True)
class Unit:
    """A unit: its exact value in SI units and the powers of kg, m, s, A, K, rad."""

    factor: sympy.Expr
    powers: tuple[int, ...]

    @property
    def si(self) -> str:
        """The SI unit of the same dimension, as the field writes it."""
        return _CUSTOMARY_BY_POWERS.get(self.powers) or _in_base_units(self.powers)


@dataclass(frozen=True)
class Quantity:
    """An exact value in the SI unit ``unit`` ("1" where it has no dimension), and where it was written."""

    value: sympy.Expr
    unit: str
    place: Place = NOWHERE


def is_unit(text: str) -> bool:
    """Whether a word is the symbol of a unit."""
    return text in _SYMBOLS


def accepted(si: str) -> str:
    """What can be written for the SI unit ``si``."""
    return _ALTERNATIVES.get(si, si)


def parse_unit(text: str, place: Place, expected: str | None = None) -> Unit:
    """The unit that ``text`` names; ``expected`` is the SI unit that it must measure, if only one will do.

    Raises InputError for an unknown unit and for one of another dimension.
    """
    unit = _read(text)
    if unit is None:
        raise InputError(place, f"unknown unit {text!r}", accepted(expected) if expected else _EXAMPLES)
    if expected is not None and unit.si != expected:
        raise InputError(place, f"{text!r} is the wrong unit", accepted(expected))
    return unit


def _read(text: str) -> Unit | None:
    above, slash, below = text.partition("/")
    factor, powers = sympy.Integer(1), [0] * len(_BASE)
    for part, sign in ((above, 1), (below, -1)) if slash else ((above, 1),):
        words = _PRODUCT.split(part.strip())
        if not part.strip() or (sign < 0 and len(words) > 1):
            return None
        for word in words:
            if word == "1" and sign > 0 and len(words) == 1:
                continue
            match = _FACTOR.match(word)
            if match is None or match[1] not in _SYMBOLS:
                return None
            power = sign * int(match[2] or 1)
            one, dimension = _SYMBOLS[match[1]]
            factor *= one**power
            powers = [p + power * d for p, d in zip(powers, dimension, strict=True)]
    return Unit(factor, tuple(powers))


def _in_base_units(powers: tuple[int, ...]) -> str:
    factors = [(name, power) for name, power in zip(_BASE, powers, strict=True) if power]
    return " ".join(f"{name}{power}" if power != 1 else name for name, power in factors)


_CUSTOMARY_BY_POWERS = {unit.powers: text for text in _CUSTOMARY if (unit := _read(text)) is not None}
