"""Reference cases as the tables of a generated self-test."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from generator.backends.printing.c_functions import Argument, CFunction
from generator.backends.printing.language import LINE
from generator.backends.printing.signals import listed
from generator.selftest import Case

#: What single precision is held to where double precision is held to ``_DOUBLE``, both relative to the largest entry;
#: a case that its own tolerance declares to be worse conditioned is looser in both by the same factor.
_FLOAT, _DOUBLE = 1e-4, 1e-9


@dataclass(frozen=True)
class Table:
    """A static array of one row per state; each row is a list of lines of source."""

    argument: Argument
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class SelfTest:
    """All cases of one function; ``sets`` are places in the list of parameter sets."""

    function: CFunction
    sets: tuple[int, ...]
    tolerances: tuple[float, ...]
    float_tolerances: tuple[float, ...]
    inputs: tuple[Table, ...]
    outputs: tuple[Table, ...]


def self_tests(
    functions: Sequence[CFunction], cases: Iterable[Case]
) -> tuple[tuple[SelfTest, ...], tuple[tuple[str, ...], ...]]:
    """The tests in the functions' order, and the parameter sets that they use, as rows of a table."""
    by_function: dict[str, list[Case]] = {}
    for case in cases:
        by_function.setdefault(case.function, []).append(case)
    sets: dict[tuple[float, ...], int] = {}
    tests = tuple(_self_test(f, by_function[f.name], sets) for f in functions if f.name in by_function)
    return tests, tuple(_row(values) for values in sets if values)


def _self_test(function: CFunction, cases: Sequence[Case], sets: dict[tuple[float, ...], int]) -> SelfTest:
    return SelfTest(
        function,
        tuple(sets.setdefault(tuple(map(float, case.parameters)), len(sets)) for case in cases),
        tuple(float(case.tolerance) for case in cases),
        tuple(_FLOAT * max(1.0, case.tolerance / _DOUBLE) for case in cases),
        tuple(_table(argument, [case.inputs for case in cases]) for argument in function.inputs),
        tuple(_table(argument, [case.outputs for case in cases]) for argument in function.outputs),
    )


def _table(argument: Argument, values: Sequence[Mapping[str, Sequence[float]]]) -> Table:
    rows = [value[argument.signal.name] for value in values]
    for row in rows:
        if len(row) != argument.size:
            raise ValueError(f"a case gives {len(row)} values for {argument.name}, which has {argument.size}")
    return Table(argument, tuple(map(_row, rows)))


def _row(values: Iterable[float]) -> tuple[str, ...]:
    lines = listed((repr(float(value)) for value in values), LINE - 8)
    return (*lines[:-1], lines[-1].rstrip(","))
