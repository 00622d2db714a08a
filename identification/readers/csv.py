"""Runs as text: a header row with the columns' names, then a row of numbers a sample.

Fields are separated by commas, semicolons, or tabs, whichever the header has; numbers have decimal points.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np

from generator.errors import InputError, Place
from identification.recording import Array, Recording, digest

EXTENSIONS = (".csv", ".tsv", ".txt")

_SEPARATORS = (",", ";", "\t")
_CHUNK = 1 << 20


@dataclass(frozen=True)
class _Layout:
    file: str
    names: tuple[str, ...]
    separator: str

    def place(self, row: int | None, column: str) -> Place:
        """Where the field of ``column`` starts in the line of ``row``, of the header if None."""
        line = 1 if row is None else row + 2
        with Path(self.file).open(encoding="utf-8-sig", errors="replace") as stream:
            text = next(islice(stream, line - 1, None), "")
        before = text.split(self.separator)[: self.names.index(column)] if column in self.names else []
        return Place(self.file, line, 1 + sum(len(field) + 1 for field in before))


def read(path: Path) -> Recording:
    """The columns of a text file; raises InputError, with line and column, for what is not a number."""
    file = str(path)
    layout = _layout(file, path)
    lines, complete = _lines(path)
    notes: tuple[str, ...] = ()
    rows: int | None = None
    if not complete and lines > 1:
        notes = (f"{file}:{lines}: the last line has no end and is left out, the file may be cut off there",)
        rows = lines - 2
    if lines < 2 or rows == 0:
        return Recording(file, {name: np.empty(0) for name in layout.names}, digest(path), layout.place, notes)
    try:
        with path.open(encoding="utf-8-sig") as stream:
            values = np.loadtxt(
                stream, delimiter=layout.separator, skiprows=1, ndmin=2, comments=None, max_rows=rows, dtype=float
            )
    except ValueError as error:
        _find_fault(path, layout, str(error))
    if rows is None and len(values) != lines - 1:
        _find_fault(path, layout, "a line is empty")
    if values.shape[1] != len(layout.names):
        _find_fault(path, layout, f"{values.shape[1]} fields a row, {len(layout.names)} names")
    columns: dict[str, Array] = dict(zip(layout.names, np.ascontiguousarray(values.T), strict=True))
    return Recording(file, columns, digest(path), layout.place, notes)


def _layout(file: str, path: Path) -> _Layout:
    try:
        with path.open(encoding="utf-8-sig") as stream:
            header = stream.readline(1 << 16).rstrip("\r\n")
    except UnicodeDecodeError:
        raise InputError(Place(file), "this is not a text in UTF-8", "a header row with the columns' names") from None
    separator = max(_SEPARATORS, key=header.count)
    names = tuple(name.strip().strip('"') for name in header.split(separator))
    layout = _Layout(file, names, separator)
    if not header.strip():
        raise InputError(Place(file), "the file is empty", "a header row with the columns' names")
    for k, name in enumerate(names):
        column = 1 + sum(len(field) + 1 for field in header.split(separator)[:k])
        if not re.match(r"[A-Za-z]\w*\Z", name):
            raise InputError(Place(file, 1, column), f"column name {name!r}", "a header row with the columns' names")
        if name in names[:k]:
            raise InputError(Place(file, 1, column), f"column {name} is there twice", "each column once")
    return layout


def _lines(path: Path) -> tuple[int, bool]:
    """The number of lines, and whether the last one is ended."""
    count, last = 0, b"\n"
    with path.open("rb") as stream:
        while chunk := stream.read(_CHUNK):
            count += chunk.count(b"\n")
            last = chunk[-1:]
    return count + (last != b"\n"), last == b"\n"


def _find_fault(path: Path, layout: _Layout, problem: str) -> None:
    """Raises InputError at the first field that is not a number."""
    with path.open(encoding="utf-8-sig", errors="replace") as stream:
        for row, text in enumerate(islice(stream, 1, None)):
            fields = text.rstrip("\r\n").split(layout.separator)
            if not text.strip():
                raise InputError(Place(layout.file, row + 2), "the line is empty", "a row of numbers")
            for name, field in zip(layout.names, fields, strict=False):
                if not _is_number(field):
                    problem = f"{name} is {field.strip()!r}" if field.strip() else f"{name} is missing"
                    raise InputError(layout.place(row, name), problem, "a number")
            if len(fields) != len(layout.names):
                problem = f"{len(fields)} fields in a row, {len(layout.names)} names in the header"
                raise InputError(Place(layout.file, row + 2), problem, "a complete row; is the file cut off?")
    raise InputError(Place(layout.file), problem, "rows of numbers under a header")


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return "_" not in field
