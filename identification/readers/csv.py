"""Runs as text: a header row with the columns' names, then a row of numbers a sample.

Fields are separated by commas, semicolons, or tabs, whichever the header has; where not by commas, a comma may be the
decimal mark of all numbers. Lines before the header that begin with # or % say nothing.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import NoReturn, TypeAlias

import numpy as np

from generator.errors import InputError, Place
from generator.robot.readers import undecodable
from identification.arrays import Array
from identification.clock_times import is_clock_time, seconds
from identification.recording import Recording, broken_off, digest, left_out, read_as_seconds
from identification.text_form import Form, decimal_mark, encoding_of, form, other_marks, split

EXTENSIONS = (".csv", ".tsv", ".txt")

#: What is wrong with a column, by its name.
Faults: TypeAlias = dict[str, InputError]

_HEADER = "a header row with the columns' names"
_SAYS_NOTHING = "; a line that begins with # or % says nothing"
_SEPARATED = "names with commas, semicolons or tabs between them, as between the numbers"
_NAME = "a name of letters, digits and _, such as q1"
_INCOMPLETE = "a complete row; is the file cut off?"
_MORE = "as many fields as names; where numbers have decimal commas, semicolons or tabs between them"
#: Letters of a name that are shown.
_SHOWN = 60
_NO_UNITS = "a number; a row of units stands before the header, behind #"
#: A unit is never taken from a name: what a sidecar does not say is in SI units.
_UNIT = f"{_NAME}, in rad; q1_deg with 'columns: {{q1: q1_deg * pi / 180}}' in the sidecar"


@dataclass(frozen=True)
class _Layout:
    file: str
    form: Form

    def place(self, row: int | None, column: str) -> Place:
        """Where the field of ``column`` starts in the line of ``row``, of the header if None."""
        names = self.form.names
        return self.at(row, names.index(column) if column in names else 0)

    def at(self, row: int | None, k: int) -> Place:
        """Where field ``k`` starts."""
        form = self.form
        line = form.header + (1 if row is None else row + 2)
        with form.path.open(encoding=form.encoding, errors="replace") as stream:
            text = next(islice(stream, line - 1, None), "")
        return Place(self.file, line, 1 + sum(len(field) + 1 for field in text.split(form.separator)[:k]))


def read(path: Path) -> Recording:
    """The columns of a text file; raises InputError, with line and column, for what is not a number."""
    file = str(path)
    layout = _layout(file, path)
    form = layout.form
    rows, cut = form.extent()
    notes: tuple[str, ...] = ()
    if cut:
        line = form.header + 1 + rows
        notes = (f"{file}:{line}: the last line has {cut} and is left out, the file may be cut off there",)
        rows -= 1
    if not rows:
        return Recording(file, {name: np.empty(0) for name in form.names}, digest(path), layout.place, notes)
    names: Sequence[str] = form.names
    words: Mapping[str, tuple[int, str]] = {}
    clocks: dict[str, Array] = {}
    faults: Faults = {}
    try:
        values = _numbers(form, rows)
    except ValueError as error:
        words = _of_words(form, rows)
        names = [name for name in form.names if name not in words]
        if not names:
            _find_fault(layout, rows, str(error))
        clocks = {name: _times(form, rows, name) for name, (_, first) in words.items() if is_clock_time(first)}
        words = {name: first for name, first in words.items() if name not in clocks}
        notes = (*notes, *read_as_seconds(file, clocks), *left_out(file, words))
        values, faults = _usable(layout, rows, names, {*words, *clocks})
        names = [name for name in names if name not in faults]
        notes = (*notes, *broken_off(faults))
    if len(values) != rows:
        _find_fault(layout, rows, "a line is empty")
    if values.shape[1] != len(names):
        _find_fault(layout, rows, f"{values.shape[1]} fields a row, {len(names)} names")
    columns: dict[str, Array] = dict(zip(names, np.ascontiguousarray(values.T), strict=True)) | clocks
    return Recording(file, columns, digest(path), layout.place, notes, words, faults)


def _numbers(form: Form, rows: int, columns: Sequence[int] | None = None) -> Array:
    """Rows of numbers (N x c), of some columns where they are given; raises ValueError for what is none."""
    return np.loadtxt(
        form.rows(rows, columns),
        delimiter=form.separator,
        ndmin=2,
        comments=None,
        quotechar='"',
        dtype=float,
        usecols=columns,
    )


def _times(form: Form, rows: int, name: str) -> Array:
    """A column (N) of times of day in s."""
    k = form.names.index(name)
    return seconds(split(text, form.separator)[k] for text in islice(form.lines(), rows))


def _of_words(form: Form, rows: int) -> dict[str, tuple[int, str]]:
    """Columns of which no row is a number, with row and text of the first field that is not empty; none where a row has
    another number of fields.
    """
    words = dict.fromkeys(range(len(form.names)), (0, ""))
    for row, text in enumerate(islice(form.lines(), rows)):
        fields = split(text, form.separator)
        if len(fields) != len(form.names):
            return {}
        words = {
            k: first if first[1] else (row, fields[k].strip())
            for k, first in words.items()
            if not form.is_number(fields[k])
        }
        if not words:
            break
    return {form.names[k]: first for k, first in words.items()}


def _undecodable(file: str, path: Path) -> InputError:
    """That a file holds what is no text: a stream tells the place in a part of it alone."""
    try:
        path.read_bytes().decode(encoding_of(path))
    except UnicodeDecodeError as error:
        return undecodable(file, error, _HEADER)
    return InputError(Place(file), "this is not a text in UTF-8", _HEADER)


def _layout(file: str, path: Path) -> _Layout:
    try:
        layout = _Layout(file, form(path))
    except UnicodeDecodeError:
        raise _undecodable(file, path) from None
    names = layout.form.names
    if names == ("",):
        raise InputError(Place(file), "the file is empty", _HEADER)
    for k, name in enumerate(names):
        if not re.match(r"[A-Za-z]\w*\Z", name):
            expected = _UNIT if re.search(r"[\[(]", name) else _NAME
            if len(names) == 1 and len(name.split()) > 1:
                expected = _SEPARATED
            if not name or layout.form.is_number(name):
                expected = f"{_HEADER}{_SAYS_NOTHING if layout.form.header else ''}"
            shown = name if len(name) <= _SHOWN else f"{name[:_SHOWN]}..."
            raise InputError(layout.at(None, k), f"column name {shown!r}", expected)
        if name in names[:k]:
            raise InputError(layout.at(None, k), f"column {name} is there twice", "each column once")
    return layout


def _usable(layout: _Layout, rows: int, names: Sequence[str], others: Collection[str]) -> tuple[Array, Faults]:
    """The numbers (N x c) of those of the columns ``names`` that hold numbers alone, and what is wrong with each of the
    rest; raises InputError where none are left, or rows have not one field for each name.

    Where there are ``others``, of words, each row is known to have as many fields as there are names.
    """
    form = layout.form
    with suppress(ValueError):
        if others:
            return _numbers(form, rows, [form.names.index(name) for name in names]), {}
    faults = _faults(layout, rows, others)
    sound = [form.names.index(name) for name in names if name not in faults]
    if not sound:
        _find_fault(layout, rows, "no column holds numbers alone")
    try:
        return _numbers(form, rows, sound), faults
    except ValueError as error:
        _find_fault(layout, rows, str(error))


def _find_fault(layout: _Layout, rows: int, problem: str) -> NoReturn:
    """Raises InputError at the first field that is not a number, or at the file where all are."""
    for fault in _faults(layout, rows).values():
        raise fault
    raise InputError(Place(layout.file), problem, "rows of numbers under a header")


def _faults(layout: _Layout, rows: int, others: Collection[str] = ()) -> Faults:
    """What is wrong with the first field that is not a number of each column but ``others``, in the order of rows;
    raises InputError where a row is empty, and where one has another number of fields than there are names.
    """
    form, mark = layout.form, ""
    faults: Faults = {}
    for row, text in enumerate(islice(form.lines(), rows)):
        line = form.header + row + 2
        if not text.strip():
            raise InputError(Place(layout.file, line), "the line is empty", "a row of numbers")
        fields = split(text, form.separator)
        for name, field in zip(form.names, fields, strict=False):
            if name in others or name in faults:
                continue
            mark = mark or decimal_mark(field)
            problem = f"{name} is {field.strip()!r}" if field.strip() else f"{name} is missing"
            if not form.is_number(field):
                units = row == 0 and not any(map(form.is_number, fields)) and not re.search(r"\d", text)
                expected = _NO_UNITS if units else "a number"
            elif form.separator != "," and other_marks(field, mark):
                expected = f"a number with {mark!r}, as in the rows before"
            else:
                continue
            faults[name] = InputError(layout.place(row, name), problem, expected)
        if len(fields) != len(form.names):
            for fault in faults.values():
                raise fault
            problem = f"{len(fields)} fields in a row, {len(form.names)} names in the header"
            raise InputError(Place(layout.file, line), problem, _INCOMPLETE if len(fields) < len(form.names) else _MORE)
    return faults
