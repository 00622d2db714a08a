"""What a comparison leaves behind: comparison.json."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from generator.errors import InputError, Place
from generator.version import VERSION
from generator.writing import replace
from identification.comparison import AGREE, Comparison, Difference
from identification.parameter_source import JSON, Known, Parameters
from identification.results import RESULTS, written

COMPARISON = "comparison.json"


def document(found: Comparison) -> dict[str, Any]:
    """The content of comparison.json, see docs/identification.md."""
    return {
        "version": VERSION,
        "method": {
            "name": "relative difference",
            "difference": "100 |b - a| / |a| (report eq. 79)",
            "agreement": f"within {AGREE:g} standard deviations of the difference, as of independent estimates",
        },
        "data": {"a": _source(found.a), "b": _source(found.b)},
        "parameters": {name: _difference(one) for name, one in found.differences.items()},
    }


def spare_reports(found: Comparison, folder: Path, report: str) -> None:
    """Raises InputError where ``folder`` holds results that are compared and their ``report``, which has the name of
    this one's.
    """
    if not os.path.exists(folder / report):
        return
    for source in (found.a, found.b):
        path = Path(source.file)
        beside = path.suffix == JSON or (folder / RESULTS).exists()
        if beside and path.parent.samefile(folder):
            problem = f"the report of {path.name} is here, which is compared"
            raise InputError(Place(str(folder)), problem, "another --out")


def save(found: Comparison, folder: Path, beside: Mapping[str, bytes] | None = None) -> list[str]:
    """Writes comparison.json and the files ``beside`` into ``folder``; returns their names.

    Raises InputError where the folder cannot be written.
    """
    files = {COMPARISON: written(document(found)).encode(), **(beside or {})}
    replace(folder, files)
    return sorted(files)


def _source(one: Parameters) -> dict[str, Any]:
    return {"name": one.name, "file": one.file, "sha256": one.sha256}


def _difference(one: Difference) -> dict[str, Any]:
    return {
        "a": _known(one.a),
        "b": _known(one.b),
        "difference_percent": one.percent,
        "deviations": one.deviations,
        "agrees": one.agrees,
        "unit": one.unit,
    }


def _known(one: Known | None) -> dict[str, Any] | None:
    """None where a side does not have the parameter; a value of None where it has it and does not know it."""
    return None if one is None else {"value": one.value, "std": one.std}
