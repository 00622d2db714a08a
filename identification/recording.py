"""What a file of a run says before anything is made of it: columns of numbers, each value with its place."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeAlias

from generator.errors import InputError, Place
from generator.words import listed
from identification.arrays import Array

#: The place of a value by its row, from 0, and its column; of the column's name without a row.
Where: TypeAlias = Callable[[int | None, str], Place]

#: The way out of a fault in some rows alone.
A_PART = "FILE@FROM:TO takes a part"

_CHUNK = 1 << 20
_WORD = re.compile(r"\w+")


def left_out(file: str, words: Collection[str]) -> tuple[str, ...]:
    """What is to be told of columns of a file that hold no number; nothing without any."""
    are = "is" if len(words) == 1 else "are"
    return (f"{file}: {listed([*words])} held no number and {are} left out",) if words else ()


def broken_off(faults: Mapping[str, InputError]) -> tuple[str, ...]:
    """What is to be told of columns that do not hold numbers alone."""
    return tuple(f"{fault.place}: {fault.problem}; the column is left out" for fault in faults.values())


def read_as_seconds(file: str, clocks: Collection[str]) -> tuple[str, ...]:
    """What is to be told of columns of a file that hold times of day; nothing without any."""
    hold = "holds" if len(clocks) == 1 else "hold"
    return (f"{file}: {listed([*clocks])} {hold} times of day, read as s from the first row",) if clocks else ()


def first_word(texts: Iterable[str]) -> tuple[int, str]:
    """Row and text of the first that says something; nothing in the first row without any."""
    return next(((row, text.strip()) for row, text in enumerate(texts) if text.strip()), (0, ""))


def by_count(file: str, names: Sequence[str]) -> Where:
    """The place of a value of a file without lines: row and column count as line and column."""

    def place(row: int | None, column: str) -> Place:
        return Place(file, 1 if row is None else row + 1, names.index(column) + 1 if column in names else 1)

    return place


@dataclass(frozen=True)
class Recording:
    """Columns by name (N each), as written.

    ``where`` tells the place of a value; ``sha256`` is of the file; ``notes`` tell what was repaired in reading. Of
    columns that were left out since they hold no number ``words`` tell the first row that says something, and what;
    ``faults`` tell what is wrong with those that were left out since they do not hold numbers alone.
    """

    file: str
    columns: Mapping[str, Array]
    sha256: str
    where: Where
    notes: tuple[str, ...] = ()
    words: Mapping[str, tuple[int, str]] = field(default_factory=dict)
    faults: Mapping[str, InputError] = field(default_factory=dict)

    @property
    def rows(self) -> int:
        """N."""
        return min(map(len, self.columns.values()), default=0)

    def part(self, first: int, last: int) -> Recording:
        """Rows ``first`` to ``last`` (not included), each at its place in the file."""

        def where(row: int | None, column: str) -> Place:
            return self.where(None if row is None else row + first, column)

        columns = {name: values[first:last] for name, values in self.columns.items()}
        return replace(self, columns=columns, where=where)

    def why_lacking(self, names: Iterable[str]) -> str:
        """What ``notes`` tell of the file's own columns ``names``, each after a semicolon; empty without any."""
        wanted = set(names)
        told = (one.removeprefix(f"{self.file}: ") for one in self.notes if one.endswith("left out"))
        return "".join(f"; {one}" for one in told if wanted & set(_WORD.findall(one)))


def digest(path: Path) -> str:
    """SHA-256 of a file's content."""
    result = hashlib.sha256()
    with path.open("rb") as stream:
        while chunk := stream.read(_CHUNK):
            result.update(chunk)
    return result.hexdigest()
