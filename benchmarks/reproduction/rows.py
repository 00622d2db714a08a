"""Rows of the tables: what is true, printed and found, side by side."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

from benchmarks.reproduction.experiment import Estimate
from generator.resources import find_robot
from generator.robot.description import ParameterValue
from generator.robot.readers import read

Row = dict[str, object]

_PRINTED = Path(__file__).parent / "printed"


def printed_set(robot: str, name: str) -> dict[str, ParameterValue]:
    """A table of the report as a robot file has it."""
    one = read(find_robot(robot)).parameter_sets[name]
    return {**one.values, **one.other_values}


def printed_numbers(table: str) -> dict[str, float]:
    """A table of ``printed/``: its second column by the first."""
    with (_PRINTED / f"{table}.csv").open(encoding="utf-8") as stream:
        rows = list(csv.reader(line for line in stream if not line.startswith("#")))[1:]
    return {name: float(value) for name, value in rows}


def parameter_rows(estimates: Mapping[str, Estimate], printed: Mapping[str, ParameterValue]) -> list[Row]:
    """A row a parameter that was found or is printed."""
    names = [*estimates, *(name for name in printed if name not in estimates)]
    return [_row(name, estimates.get(name), printed.get(name)) for name in names]


def residual_rows(found: Sequence[float], table: str) -> list[Row]:
    """A row an axis: ||e|| / ||Y - mean(Y)||."""
    printed = printed_numbers(table)
    return [
        {
            "axis": int(axis),
            "printed [%]": f"{value:.3g}",
            "ours [%]": f"{ours:.3g}",
            "ours / printed": f"{ours / value:.2f}",
        }
        for (axis, value), ours in zip(printed.items(), found, strict=True)
    ]


def _row(name: str, found: Estimate | None, printed: ParameterValue | None) -> Row:
    return {
        "parameter": name,
        "unit": found.unit if found else printed.unit if printed else "",
        "true": _number(found.true if found else None),
        "printed": _number(printed.value if printed else None),
        "printed std [%]": _number(printed.relative_std if printed else None),
        "identified": _number(found.value if found else None),
        "std": _number(found.std if found else None, 2),
        "std [%]": _number(100 * found.std / abs(found.value) if found and found.value else None, 2),
        "inside": None if found is None else "yes" if found.inside else "**no**",
    }


def _number(value: float | None, digits: int = 4) -> str | None:
    return None if value is None else f"{value:.{digits}g}"
