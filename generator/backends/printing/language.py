"""What a target language says differently, as data; the printing itself is the same for all of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

#: Columns that a printed expression, list or paragraph takes at most: a longer expression is cut into temporaries.
LINE = 100
#: Columns of a statement that its indentation and the name of its variable take.
_MARGIN = 12


@dataclass(frozen=True)
class Language:
    """Facts of a target language.

    ``calls`` maps an operation of the program (``sin``, ``pow``, ...) to what is called for it; where it does not hold
    ``directed``, that is a product with ``sign``. ``statement`` and ``literal`` are formats of ``name`` and ``value``.
    ``argument`` is one of the name that an input of a Python function has, made from that of its signal. ``reserved``
    are the words that no variable may be called.
    """

    calls: Mapping[str, str]
    statement: str
    literal: str
    reserved: frozenset[str]
    line: int = LINE
    argument: str = "{name}"

    def number(self, value: Fraction) -> str:
        """The shortest decimal literal that reads back as the double nearest to a nonnegative ``value``.

        Raises OverflowError for a value that no double holds.
        """
        return self.literal.format(value=repr(float(value)))

    def assign(self, name: str, value: str) -> str:
        """The statement that defines a local variable."""
        return self.statement.format(name=name, value=value)

    @cached_property
    def width(self) -> int:
        """Columns that an expression may take in a statement."""
        return self.line - _MARGIN - len(self.statement.format(name="", value=""))
