"""Results of cases as the repository keeps them, a line each: every case that was ever drawn, as the last code that was
asked about it answered. A study goes on where it was on any machine.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from benchmarks.diagnosis_study.case import case

ARCHIVE = Path(__file__).parents[1] / "diagnosis_cases.jsonl"


def archived(archive: Path = ARCHIVE) -> list[dict[str, Any]]:
    """The results, each with the ``code`` that it came from; none without a file."""
    if not archive.exists():
        return []
    return [json.loads(line) for line in archive.read_text(encoding="utf-8").splitlines()]


def restore(folder: Path, archive: Path = ARCHIVE) -> None:
    """The archive's results put into the folder of results of the same code, as far as it lacks them."""
    folder.mkdir(parents=True, exist_ok=True)
    for one in archived(archive):
        file = folder / f"{_name(one)}.json"
        if one.pop("code") == folder.name and not file.exists():
            file.write_text(json.dumps(one, indent=1) + "\n", encoding="utf-8")


def store(code: str, results: Iterable[Mapping[str, Any]], archive: Path = ARCHIVE) -> None:
    """The archive with all results of a code, without the whole answers, in the place of what earlier codes said of the
    same cases. Of earlier codes' cases those stay that were asked about: scored, or broken off.
    """
    records = {_name(one): one for one in archived(archive) if one["code"] != code and "skipped" not in one}
    records |= {_name(one): {"code": code, **_short(one)} for one in results}
    text = "".join(json.dumps(records[name], separators=(",", ":")) + "\n" for name in sorted(records))
    archive.write_text(text, encoding="utf-8")


def asked(archive: Path = ARCHIVE) -> frozenset[str]:
    """Names of the cases that are in the archive."""
    return frozenset(map(_name, archived(archive)))


def _name(one: Mapping[str, Any]) -> str:
    return case(one["case"]).name


def _short(one: Mapping[str, Any]) -> dict[str, Any]:
    """What the case itself says stands once."""
    result = {key: value for key, value in one.items() if key != "answer"}
    if "truth" in one:
        result["truth"] = {key: value for key, value in one["truth"].items() if key != "case"}
    return result
