"""Taking values of the right kind out of a robot file, with one clear line where they are not."""

from __future__ import annotations

import difflib
import re
import unicodedata
from collections.abc import Iterable, Sequence
from typing import SupportsFloat

import sympy

from generator import expressions
from generator.errors import InputError, Place
from generator.robot.document import Entry, Items, Node, Table, Text
from generator.units import Quantity

#: Three such numbers make a product within the range of single precision, 1e-38 to 3e38.
_LEAST, _MOST = 1e-12, 1e12

#: Characters that embed, override or isolate a direction of writing (Unicode annex 9): text is not what it looks like.
_TURNING = frozenset(map(chr, (*range(0x202A, 0x202F), *range(0x2066, 0x206A))))

_INTEGER = re.compile(r"[+-]?\d{1,9}\Z", re.ASCII)


def table(node: Node, what: str, required: Sequence[str] = (), optional: Sequence[str] = ()) -> dict[str, Entry]:
    """The entries of a table. Raises InputError for another kind, an unknown key and a missing one."""
    if not isinstance(node, Table):
        raise InputError(node.place, f"{what} is {_kind(node)}", "a table with keys")
    known = [*required, *optional]
    for key, entry in node.entries.items():
        if key not in known:
            raise InputError(entry.key, f"unknown key {_short(key)} in {what}", nearest(key, known))
    for key in required:
        if key not in node.entries:
            raise InputError(node.place, f"{what} has no key {key!r}", f"the keys {', '.join(required)}")
    return dict(node.entries)


def named(node: Node, what: str) -> dict[str, Entry]:
    """The entries of a table whose keys are names of the user's own."""
    if not isinstance(node, Table):
        raise InputError(node.place, f"{what} is {_kind(node)}", "a table with names as keys")
    return dict(node.entries)


def items(node: Node, what: str, count: int | None = None, of: str = "values") -> tuple[Node, ...]:
    """The items of a list, ``count`` of them if given."""
    if not isinstance(node, Items):
        raise InputError(node.place, f"{what} is {_kind(node)}", f"a list of {f'{count} ' if count else ''}{of}")
    if count is not None and len(node.items) != count:
        raise InputError(node.place, f"{what} has {len(node.items)} {of}", str(count))
    return node.items


def text(node: Node, what: str, expected: str = "a text") -> Text:
    """A scalar."""
    if not isinstance(node, Text):
        raise InputError(node.place, f"{what} is {_kind(node)}", expected)
    if not node.content and not node.quoted:
        raise InputError(node.place, f"{what} is empty", expected)
    return node


def prose(entry: Entry | None, what: str) -> str:
    """A text for people, its white space made single; empty where there is none. Raises InputError for characters of
    control, among them those that turn how others are shown.
    """
    line = "" if entry is None else " ".join(text(entry.value, what).content.split())
    for character in line:
        if entry is not None and (unicodedata.category(character) == "Cc" or character in _TURNING):
            problem = f"{what} holds U+{ord(character):04X}, a character of control"
            raise InputError(entry.value.place, problem, "characters that are seen")
    return line


def integer(node: Node, what: str, expected: str = "an integer") -> int:
    """A plain integer."""
    scalar = text(node, what, expected)
    if scalar.quoted or not _INTEGER.match(scalar.content):
        raise InputError(node.place, f"{what} is {_short(scalar.content)}", expected)
    return int(scalar.content)


def boolean(node: Node, what: str) -> bool:
    """``true`` or ``false``."""
    scalar = text(node, what, "true or false")
    if scalar.quoted or scalar.content not in ("true", "false"):
        raise InputError(node.place, f"{what} is {_short(scalar.content)}", "true or false")
    return scalar.content == "true"


def word(node: Node, what: str, known: Sequence[str]) -> str:
    """One of the ``known`` words."""
    scalar = text(node, what, nearest("", known))
    if scalar.content not in known:
        raise InputError(node.place, f"{what} is {_short(scalar.content)}", nearest(scalar.content, known))
    return scalar.content


def expression(node: Node, what: str) -> sympy.Expr:
    """An exact expression over names."""
    scalar = text(node, what, "an expression")
    try:
        return expressions.parse(scalar.content, scalar.inside or scalar.place)
    except InputError as error:
        raise _placed(error, scalar) from None


def number(node: Node, what: str) -> sympy.Expr:
    """An exact finite number without a unit."""
    scalar = text(node, what, "a number")
    try:
        return expressions.parse_number(scalar.content, scalar.inside or scalar.place)
    except InputError as error:
        raise _placed(error, scalar) from None


def quantity(node: Node, what: str, unit: str | None) -> Quantity:
    """A number with its unit, in SI; ``unit`` is the SI unit it must measure, None for any."""
    scalar = text(node, what, "a number with its unit")
    try:
        return expressions.parse_quantity(scalar.content, unit, scalar.inside or scalar.place)
    except InputError as error:
        raise _placed(error, scalar) from None


def check_size(place: Place, what: str, value: SupportsFloat, any_small: bool = False) -> None:
    """Raises InputError for a number of a size that code in single precision cannot compute with: with products of a
    few of them, or divided by them. What nothing is divided by may be as small as it will.
    """
    size = abs(float(value))
    if size > _MOST or (0 < size < _LEAST and not any_small):
        expected = f"at most {_MOST:g} either way" if any_small else f"a size from {_LEAST:g} to {_MOST:g}"
        raise InputError(place, f"{what} is {float(value):g}", expected)


def sized_quantity(node: Node, what: str, unit: str) -> sympy.Expr:
    """The value in SI units of ``quantity``, of a size that single precision computes with: however small."""
    value = quantity(node, what, unit).value
    check_size(node.place, what, value, any_small=True)
    return value


def nearest(name: str, known: Iterable[str]) -> str:
    """What was probably meant by ``name``, or all that could be."""
    known = list(known)
    near = difflib.get_close_matches(name, known, n=1)
    if near:
        return f"perhaps {near[0]!r}"
    return f"one of {', '.join(known)}" if known else "none"


def _placed(error: InputError, scalar: Text) -> InputError:
    """The error at the scalar's start where columns inside it do not match the file's."""
    return error if scalar.inside else InputError(scalar.place, error.problem, error.expected)


def _kind(node: Node) -> str:
    if isinstance(node, Text):
        return f"the text {_short(node.content)}" if node.content or node.quoted else "empty"
    return "a list" if isinstance(node, Items) else "a table"


def _short(content: str) -> str:
    line = " ".join(content.split())
    return repr(line if len(line) <= 40 else f"{line[:37]}...")
