"""Runs the studies: ``python -m benchmarks.bench [only=NAME...]``.

Prints a table for each, writes ``benchmarks/results.json``, and from it the tables and the picture of the documents.
``only`` runs the studies named and keeps the other results, which must be of this machine. The exit status is 1 where
results of a row disagree or a study broke down, 2 for a wrong name.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from typing import Any

import benchmarks.studies
from benchmarks.documents import RESULTS, ROOT, documented
from benchmarks.machine import machine, missing
from benchmarks.study import measured, shown, status
from generator.discovery import modules
from generator.errors import InputError, Place

_ONLY = "only="


def main(words: Sequence[str]) -> int:
    """Measures, prints and writes; returns the exit status."""
    studies = {module.__name__.rpartition(".")[2]: module for module in modules(benchmarks.studies)}
    try:
        names = _chosen(words, list(studies))
        results = _kept(names, list(studies))
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    if absent := list(missing()):
        print(f"missing, so that some rows are not measured: {', '.join(absent)}", flush=True)
    new = {}
    for name in names:
        new[name] = measured(name, studies[name])
        print(f"\n{new[name]['title']}\n\n{shown(new[name])}", flush=True)
    known = {**results, **new}
    results = {name: known[name] for name in studies if name in known}
    told = {"machine": machine(), "studies": results}
    RESULTS.write_text(json.dumps(told, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    for path, text in documented(told).items():
        (ROOT / path).write_text(text, encoding="utf-8")
    return status(list(new.values()))


def _chosen(words: Sequence[str], known: Sequence[str]) -> list[str]:
    """The studies to run: all, or those of ``only=``."""
    joined = " ".join(word.removeprefix(_ONLY) for word in words)
    names = joined.replace(",", " ").split() or list(known)
    for name in names:
        if name not in known:
            raise InputError(Place("benchmarks/studies"), f"there is no study {name!r}", f"one of {', '.join(known)}")
    return names


def _kept(chosen: Sequence[str], known: Sequence[str]) -> dict[str, Any]:
    """Earlier results of the studies that are not run now."""
    if set(chosen) == set(known) or not RESULTS.exists():
        return {}
    earlier = json.loads(RESULTS.read_text(encoding="utf-8"))
    if earlier["machine"] != machine():
        place = Place(str(RESULTS.relative_to(ROOT)))
        raise InputError(place, "its results are of another machine or other versions", "make bench without only=")
    studies: dict[str, Any] = earlier["studies"]
    return studies


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
