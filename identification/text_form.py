"""How a text with a row of numbers a line is written: its encoding, header, separator and decimal mark."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

_SEPARATORS = (",", ";", "\t")
_COMMENTS = ("#", "%")
#: What spreadsheets write first.
_SAID = "sep="
_MARKS = (",", ".")
_ORDER_MARKS = (b"\xff\xfe", b"\xfe\xff")
_LONGEST = 1 << 16


@dataclass(frozen=True)
class Form:
    """``header`` is the line of the columns' ``names``, from 0; ``trailing`` tells that a separator ends each row."""

    path: Path
    encoding: str
    header: int
    separator: str
    names: tuple[str, ...]
    trailing: bool

    def lines(self) -> Iterator[str]:
        """Of the rows under the header, as written but for a separator at the end; also where they are no text."""
        with self.path.open(encoding=self.encoding, errors="replace") as stream:
            for line in islice(stream, self.header + 1, None):
                yield self._ended(line)

    def rows(self, count: int, used: Sequence[int] | None = None) -> Iterator[str]:
        """The first ``count`` lines under the header with decimal points; raises ValueError for two decimal marks in
        the fields that are ``used``, all if None.
        """
        mark = ""
        with self.path.open(encoding=self.encoding) as stream:
            for line in islice(stream, self.header + 1, self.header + 1 + count):
                if self.separator == ",":
                    yield self._ended(line)
                    continue
                fields = split(line, self.separator) if used is not None else []
                numbers = line if used is None else " ".join(fields[k] for k in used if k < len(fields))
                mark = mark or decimal_mark(numbers)
                if other_marks(numbers, mark):
                    raise ValueError("two decimal marks")
                yield self._ended(line).replace(",", ".")

    def extent(self) -> tuple[int, str]:
        """The number of lines under the header without empty ones at the end, and in words what the last one is without
        if it is cut off: its end, or fields after others that are complete; empty where it is whole.
        """
        number, last, empty = 0, "\n", f" \t\r\n{self.separator}"
        with self.path.open(encoding=self.encoding, errors="replace") as stream:
            for k, line in enumerate(islice(stream, self.header + 1, None), 1):
                if line.strip(empty):
                    number, last = k, line
        if not last.endswith("\n"):
            return number, "no end"
        count, names = len(split(self._ended(last), self.separator)), len(self.names)
        return number, f"{count} of {names} fields" if number > 1 and count < names else ""

    def is_number(self, field: str) -> bool:
        """Whether a field is one as this text writes them."""
        try:
            float(field if self.separator == "," else field.replace(",", "."))
        except ValueError:
            return False
        return field.isascii() and "_" not in field

    def _ended(self, line: str) -> str:
        return line.rstrip("\n").removesuffix(self.separator) if self.trailing else line


def encoding_of(path: Path) -> str:
    """Of a text, told by its order mark."""
    with path.open("rb") as stream:
        return "utf-16" if stream.read(2) in _ORDER_MARKS else "utf-8-sig"


def form(path: Path) -> Form:
    """The form of the text ``path``, told by its first lines; ``names`` are as written, without quotes and blanks.

    Raises UnicodeDecodeError where they are neither UTF-8 nor, after a byte order mark, UTF-16.
    """
    encoding = encoding_of(path)
    separator, number = "", 0
    with path.open(encoding=encoding) as text:
        while (line := text.readline(_LONGEST)) and (not line.strip() or line.startswith((*_COMMENTS, _SAID))):
            separator = line.removeprefix(_SAID).rstrip("\n") if line.startswith(_SAID) else separator
            number += 1
        first = text.readline(_LONGEST)
    if separator not in _SEPARATORS:
        separator = max(_SEPARATORS, key=line.count)
    names = [name.strip() for name in split(line, separator)]
    if len(names) > 1 and not names[-1]:
        del names[-1]
    fields = split(first, separator)
    trailing = len(fields) == len(names) + 1 and not fields[-1].strip()
    return Form(path, encoding, number, separator, tuple(names), trailing)


def split(line: str, separator: str) -> list[str]:
    """The fields of a line, without the quotes that may be around them."""
    line = line.rstrip("\r\n")
    if '"' not in line:
        return line.split(separator)
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True))
    except csv.Error:
        return line.split(separator)


def decimal_mark(text: str) -> str:
    """The first one of a text, empty where it has none."""
    return next((character for character in text if character in _MARKS), "")


def other_marks(text: str, mark: str) -> bool:
    """Whether a text has another decimal mark than ``mark``."""
    return any(one in text for one in _MARKS if one != mark)
