"""Section ``drives``: gear ratios, wrist coupling and torque constants (report eq. 14-18, Tables 1-3)."""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction

import sympy

from generator.errors import InputError
from generator.robot import fields
from generator.robot.description import FIXED, PRISMATIC, Drives, Joint
from generator.robot.document import Entry, Node, Text
from generator.robot.names import identifier
from generator.units import parse_unit

Matrix = tuple[tuple[sympy.Expr, ...], ...]

_ELEMENT = re.compile(r"N(?:([1-9])([1-9])|([1-9]\d*)_([1-9]\d*))\Z", re.ASCII)
_CONVENTIONS = ("row", "as_printed", "direct")


def drives(entry: Entry | None, joints: Sequence[Joint]) -> Drives | None:
    """The drive train, exact; None where the file has none.

    Raises InputError for a ratio that is zero, a number of turning joints that is not rational, a list that does not
    have one value per moving joint, a coupling element that is not below the diagonal, a torque constant that is not
    positive, a drift that is not within -1 and 1, a size that no drive has (``fields.check_size``).
    """
    if entry is None:
        return None
    keys = fields.table(entry.value, "drives", ("gear_ratios",), ("coupling", "torque_constants", "torque_drift"))
    driven = [joint for joint in joints if joint.sigma != FIXED]
    moving = [joint.number for joint in driven]
    ratios = _ratios(keys["gear_ratios"].value, driven)
    coupling = _coupling(keys.get("coupling"), ratios, driven)
    constants, in_use = _torque_constants(keys.get("torque_constants"), moving)
    return Drives(ratios, coupling, constants, in_use, _torque_drift(keys.get("torque_drift"), constants, moving))


def _torque_drift(entry: Entry | None, constants: object, moving: Sequence[int]) -> tuple[Fraction, ...]:
    if entry is None:
        return ()
    if not constants:
        raise InputError(entry.key, "torque_drift without torque_constants", "both")
    drift = []
    for number, item in zip(moving, fields.items(entry.value, "torque_drift", len(moving)), strict=True):
        value = _fraction(item, f"torque_drift of joint {number}")
        if not -1 < value < 1:
            raise InputError(
                item.place, f"torque_drift of joint {number} is {float(value):g}", "more than -1, less than 1"
            )
        drift.append(value)
    return tuple(drift)


def _ratios(node: Node, driven: Sequence[Joint]) -> tuple[sympy.Expr, ...]:
    ratios = []
    for joint, item in zip(driven, fields.items(node, "gear_ratios", len(driven), "gear ratios"), strict=True):
        what = f"gear ratio of joint {joint.number}"
        ratio = _ratio(item, what, (joint,))
        if ratio == 0:
            raise InputError(item.place, f"{what} is zero", "a ratio other than zero")
        ratios.append(ratio)
    return tuple(ratios)


def _coupling(entry: Entry | None, ratios: Sequence[sympy.Expr], driven: Sequence[Joint]) -> Matrix:
    """The matrix N: motor speed = N joint speed.

    ``row``: N = diag(ratios) (I + L)^-1, L the given coefficients: the row's ratio multiplies, as gear teeth do.
    ``as_printed``: N = (I + L)^-1 diag(ratios), the formulas printed under the report's Table 2.
    ``direct``: the given coefficients are the elements of N themselves.
    """
    n = len(ratios)
    moving = [joint.number for joint in driven]
    lower: list[list[sympy.Expr]] = [[sympy.Integer(0)] * n for _ in range(n)]
    convention, seen = "row", set()
    for key, one in fields.named(entry.value, "coupling").items() if entry else ():
        if key == "convention":
            convention = fields.word(one.value, "convention of coupling", _CONVENTIONS)
            continue
        row, column = _element(Text(key, one.key), moving)
        if (row, column) in seen:
            raise InputError(one.key, f"coupling coefficient {key} is given twice", "it once")
        seen.add((row, column))
        lower[row][column] = _ratio(one.value, key, (driven[row], driven[column]), any_small=True)
    if convention == "direct":
        return tuple(tuple(ratios[i] if i == k else lower[i][k] for k in range(n)) for i in range(n))
    inverse = _inverse_of_unit_lower(lower)
    if convention == "row":
        return tuple(tuple(sympy.expand(ratios[i] * inverse[i][k]) for k in range(n)) for i in range(n))
    return tuple(tuple(sympy.expand(inverse[i][k] * ratios[k]) for k in range(n)) for i in range(n))


def element(name: str) -> tuple[int, int] | None:
    """The joints' numbers (row, column) of an element of the coupling such as ``N54`` or ``N10_4``; None for other
    names.
    """
    match = _ELEMENT.match(name)
    return None if match is None else (int(match[1] or match[3]), int(match[2] or match[4]))


def element_name(row: int, column: int) -> str:
    """The name that ``element`` reads."""
    return f"N{row}{column}" if max(row, column) < 10 else f"N{row}_{column}"


def _element(key: Text, moving: Sequence[int]) -> tuple[int, int]:
    pair = element(key.content)
    if pair is None:
        raise InputError(key.place, f"unknown key {key.content!r} in coupling", "convention or an element such as N54")
    row, column = pair
    for number in (row, column):
        if number not in moving:
            raise InputError(key.place, f"{key.content}: joint {number} does not move or exist", "moving joints")
    if column >= row:
        order = "joints in an order in which a motor's own joint is the last it turns with"
        raise InputError(
            key.place, f"{key.content} is not below the diagonal", f"a row greater than the column: {order}"
        )
    return moving.index(row), moving.index(column)


def _inverse_of_unit_lower(lower: Sequence[Sequence[sympy.Expr]]) -> list[list[sympy.Expr]]:
    """(I + L)^-1 by forward substitution, L strictly lower triangular."""
    n = len(lower)
    inverse: list[list[sympy.Expr]] = []
    for i in range(n):
        unit = [sympy.Integer(int(i == k)) for k in range(n)]
        inverse.append([unit[k] - sympy.Add(*(lower[i][m] * inverse[m][k] for m in range(i))) for k in range(n)])
    return inverse


def _torque_constants(entry: Entry | None, moving: Sequence[int]) -> tuple[dict[str, tuple[Fraction, ...]], str]:
    if entry is None:
        return {}, ""
    keys = fields.named(entry.value, "torque_constants")
    for key in ("unit", "use"):
        if key not in keys:
            raise InputError(entry.value.place, f"torque_constants has no key {key!r}", "the keys unit and use")
    unit = fields.text(keys.pop("unit").value, "unit of torque_constants", "N m/A")
    factor = parse_unit(unit.content, unit.place, "N m/A").factor
    if not factor.is_Rational:
        raise InputError(unit.place, f"unit {unit.content} is no fraction of N m/A", "one such as N m/A or kN m/A")
    use = keys.pop("use")
    found = {
        identifier(Text(key, one.key), "torque constants"): _constants(one.value, key, factor, moving)
        for key, one in keys.items()
    }
    return found, fields.word(use.value, "use of torque_constants", tuple(found))


def _constants(node: Node, key: str, factor: sympy.Expr, moving: Sequence[int]) -> tuple[Fraction, ...]:
    constants = []
    for number, item in zip(moving, fields.items(node, f"torque constants {key}", len(moving), "values"), strict=True):
        what = f"torque constant of joint {number}"
        value = _fraction(item, what) * Fraction(int(factor.p), int(factor.q))
        if value <= 0:
            raise InputError(item.place, f"{what} is not positive", "a number above 0")
        fields.check_size(item.place, what, value)
        constants.append(value)
    return tuple(constants)


def _ratio(node: Node, what: str, between: Sequence[Joint], any_small: bool = False) -> sympy.Expr:
    """A ratio of what moves with the joints ``between``: teeth make fractions, a spindle or a pinion makes pi."""
    value = fields.number(node, what)
    if all(joint.sigma != PRISMATIC for joint in between):
        _check_fraction(node, what, value)
    fields.check_size(node.place, what, value, any_small)
    return value


def _fraction(node: Node, what: str) -> Fraction:
    value = fields.number(node, what)
    _check_fraction(node, what, value)
    return Fraction(int(value.p), int(value.q))


def _check_fraction(node: Node, what: str, value: sympy.Expr) -> None:
    if not value.is_Rational:
        raise InputError(node.place, f"{what} is not a fraction", "a fraction such as -5473/21")
