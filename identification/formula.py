"""Columns of a foreign file under this project's names: ``tau1: vir * gtau``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any

import numpy as np
import sympy

from generator import expressions
from generator.errors import InputError
from generator.robot import fields
from generator.robot.document import Entry, Text
from identification.arrays import Array
from identification.recording import Recording
from identification.signals import NAMES, meant

#: What is told of times such as 12:03:04.
_CLOCK = "; a time of day as seconds, 12:00:01.5 as 43201.5"


@dataclass(frozen=True)
class Formula:
    """An exact expression over the names of a file's columns."""

    expression: sympy.Expr
    text: Text

    def values(self, recording: Recording) -> Array:
        """The column (N); raises InputError where the file lacks a name of the formula, or holds words under it, one
        among numbers too.
        """
        names = sorted(symbol.name for symbol in self.expression.free_symbols)
        for name in names:
            if name in recording.words:
                row, word = recording.words[name]
                problem = f"{name} holds no number in any row, the first is {word!r}"
                expected = f"numbers for the formula at {self.text.place}{_CLOCK if ':' in word else ''}"
                raise InputError(recording.where(row, name), problem, expected)
            if name in recording.faults:
                raise recording.faults[name]
            if name not in recording.columns:
                problem = f"{recording.file} has no column {name}"
                raise InputError(self.text.place, problem, f"one of {', '.join(recording.columns)}")
        # What a division by zero makes, or a number too large, is refused as any other that is not finite.
        with np.errstate(all="ignore"):
            result = _value(self.expression, recording.columns)
        return np.array(np.broadcast_to(np.asarray(result, dtype=float), (recording.rows,)))


def _value(expression: sympy.Expr, columns: Mapping[str, Array]) -> Array:
    """The numbers that an expression of sums, products and powers says (N, or one), names standing for ``columns``."""
    if isinstance(expression, sympy.Symbol):
        return columns[expression.name]
    if not expression.free_symbols:
        try:
            return np.asarray(float(expression))
        except OverflowError:
            return np.asarray(np.inf)
    parts = [_value(one, columns) for one in expression.args]
    of = {sympy.Add: np.add, sympy.Mul: np.multiply, sympy.Pow: np.power}[expression.func]
    return np.asarray(reduce(of, parts))


def formulas(entry: Entry | None) -> dict[str, Formula]:
    """The formulas of a table ``columns``; raises InputError for a name without a meaning and for no expression."""
    if entry is None:
        return {}
    result = {}
    for name, one in fields.named(entry.value, "columns").items():
        if not meant(name):
            raise InputError(one.key, f"column {name} means nothing", f"one of {NAMES}")
        text = fields.text(one.value, f"column {name}", "an expression over the file's columns")
        result[name] = Formula(expressions.parse(text.content, text.inside or text.place), text)
    return result


def renamed(recording: Recording, given: Mapping[str, Formula]) -> Recording:
    """The recording with the columns of ``given`` added; what the file itself has is replaced."""
    if not given:
        return recording
    added = {name: formula.values(recording) for name, formula in given.items()}

    def where(row: int | None, column: str) -> Any:
        """A made column stands where the first column it is made of stands."""
        if column in given:
            names = [symbol.name for symbol in given[column].expression.free_symbols]
            column = min(names, key=list(recording.columns).index, default=column)
        return recording.where(row, column)

    columns = {**recording.columns, **added}
    return replace(recording, columns=columns, where=where)
