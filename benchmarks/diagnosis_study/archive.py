"""Results of cases as the repository keeps them, a line each, so that a study goes on where it was on any machine."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from benchmarks.diagnosis_study.case import case

#: First the code that the results came from, then the results.
ARCHIVE = Path(__file__).parents[1] / "diagnosis_cases.jsonl"


def archived(archive: Path = ARCHIVE) -> tuple[str, list[dict[str, Any]]]:
    """The code that the results came from, and the results; neither without a file."""
    if not archive.exists():
        return "", []
    first, *results = map(json.loads, archive.read_text(encoding="utf-8").splitlines())
    return first["code"], results


def restore(folder: Path, archive: Path = ARCHIVE) -> None:
    """The archive's results put into the folder of results of the same code, as far as it lacks them."""
    code, results = archived(archive)
    if code != folder.name:
        return
    folder.mkdir(parents=True, exist_ok=True)
    for one in results:
        file = folder / f"{case(one['case']).name}.json"
        if not file.exists():
            file.write_text(json.dumps(one, indent=1) + "\n", encoding="utf-8")


def store(code: str, results: Iterable[Mapping[str, Any]], archive: Path = ARCHIVE) -> None:
    """The archive made anew from all results of a code, without the whole answers."""
    records = [{"code": code}, *map(_short, results)]
    text = "".join(json.dumps(one, separators=(",", ":")) + "\n" for one in records)
    archive.write_text(text, encoding="utf-8")


def _short(one: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in one.items() if key != "answer"}
