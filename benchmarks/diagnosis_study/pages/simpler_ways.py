"""The diagnosis beside simpler ways on the same runs, as the rows of a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from benchmarks.diagnosis_study.pages.intervals import share
from benchmarks.diagnosis_study.pages.questions import TITLES
from benchmarks.diagnosis_study.pages.summary import MODES, Result, Row, of
from benchmarks.diagnosis_study.runner import BASELINES
from benchmarks.diagnosis_study.study import STUDY


def rows_of_simpler_ways(results: Sequence[Result]) -> list[Row]:
    """The diagnosis and simpler ways on the same runs."""
    rows: list[Row] = []
    for cell in BASELINES:
        cases = [one for mode in MODES for one in of(results, cell, mode) if "baselines" in one]
        if not cases:
            continue
        ways = {"the diagnosis": [(one, _pairs(one["score"]["named"])) for one in cases]}
        for way in dict.fromkeys(way for one in cases for way in one["baselines"]):
            ways[way] = [
                (one, [(name, int(joint)) for name, joint in one["baselines"][way]])
                for one in cases
                if way in one["baselines"]
            ]
        for way, asked in ways.items():
            truths, named = [one["truth"]["hidden"] for one, _ in asked], [names for _, names in asked]
            named_any = share([bool(names) for names in named])
            row: Row = {"cell": TITLES[cell], "way": way, "named something": str(named_any)}
            row["names a case"] = f"{sum(map(len, named)) / len(named):.1f}"
            if cell.startswith("one"):
                there = [any(_right(name, truth) for name in names) for names, truth in zip(named, truths, strict=True)]
                only = [hit and len(names) == 1 for hit, names in zip(there, named, strict=True)]
                row |= {"truth among them": str(share(there)), "and nothing else": str(share(only))}
            rows.append(row)
    return rows


def _pairs(named: Sequence[str]) -> list[tuple[str, int]]:
    found = []
    for one in named:
        effect, _, joints = one.partition(" ")
        numbers = [int(x) for x in joints.strip("[]").split(",") if x.strip()]
        found.append((effect, numbers[0] if numbers else 0))
    return found


def _right(name: tuple[str, int], truth: Sequence[Mapping[str, Any]]) -> bool:
    for one in truth:
        expected = STUDY.laws.get(one["law"])
        if expected and name[0] in expected.named and (expected.anywhere or name[1] == one["joint"]):
            return True
    return False
