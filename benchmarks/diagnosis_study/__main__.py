"""``python -m benchmarks.diagnosis_study [--cases N] [--cells A B ...]``: the study, its results and its page."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping
from math import inf
from typing import Any

from benchmarks.diagnosis_study.archive import archived, asked, restore, store
from benchmarks.diagnosis_study.drawing import MODES, cells
from benchmarks.diagnosis_study.pages.page import JSON, tables, write
from benchmarks.diagnosis_study.runner import Plan, folder_of_results, kept, run


def main() -> int:
    """Run what is missing, then write all that there is."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=200, help="of each cell and mode")
    parser.add_argument("--cells", nargs="+", choices=cells(), default=list(cells()))
    parser.add_argument("--modes", nargs="+", choices=MODES, default=list(MODES))
    parser.add_argument("--baselines", type=int, default=20, help="cases of each that simpler ways are asked as well")
    parser.add_argument("--minutes", type=float, default=inf, help="after which no case begins")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--development", action="store_true", help="without the reserved laws, and nothing is written")
    parser.add_argument("--new", action="store_true", help="draws behind those that any code was asked about")
    told = parser.parse_args()
    wanted = tuple((cell, mode) for cell in told.cells for mode in told.modes)
    plan = Plan(
        wanted,
        told.cases,
        told.baselines,
        told.minutes,
        reserved=not told.development,
        processes=told.processes,
        asked=asked() if told.new else frozenset(),
    )
    made, folder = [], folder_of_results(plan.reserved)
    restore(folder)
    for one in run(plan, folder):
        made.append(one)
        print(_line(one), flush=True)
    if told.development:
        found = tables(made, made)
        print(json.dumps({key: found[key] for key in ("counts", "cells", "baselines")}, indent=1))
        return 0
    results = kept(folder)
    store(folder.name, results)
    every = archived()
    found = tables(results, every)
    JSON.write_text(json.dumps({"code": folder.name, **found}, indent=1) + "\n", encoding="utf-8")
    write(every, found)
    return int(any("failed" in one for one in results))


def _line(one: Mapping[str, Any]) -> str:
    case = one["case"]
    hidden = ", ".join(f"{what['law']} {what['joint']}" for what in case["hidden"]) or "nothing"
    said = one.get("skipped") or one.get("failed")
    if said is None:
        score = one["score"]
        said = f"{score['verdict']}: {', '.join(score['named']) or 'nothing'} ({one['seconds']:.0f} s)"
    return f"{case['cell']} {case['mode']} {case['robot']} {case['motion']} {case['seed']}: {hidden} -> {said}"


if __name__ == "__main__":
    sys.exit(main())
