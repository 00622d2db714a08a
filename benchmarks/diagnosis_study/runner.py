"""Cases run: made, given to the command line, scored; a result file each, so that a study can go on where it was."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Container, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from dataclasses import asdict, dataclass
from itertools import islice
from math import inf
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.diagnosis_study.asking import diagnose
from benchmarks.diagnosis_study.baselines import named_by_baselines
from benchmarks.diagnosis_study.case import Case, Hidden
from benchmarks.diagnosis_study.case import case as case_of
from benchmarks.diagnosis_study.drawing import cases
from benchmarks.diagnosis_study.making import made
from benchmarks.diagnosis_study.scoring import scored
from benchmarks.diagnosis_study.sizing import OutOfReach
from benchmarks.diagnosis_study.state import ROOT, state
from tests.plant.simulate import RanAway

#: Where results of cases are kept, by the code that they came from.
RESULTS = ROOT / "build" / "diagnosis_study"
#: Largest mismatch of a null case, in multiples of the noise: cases above are scored apart.
MISMATCH = 0.05
#: Processes share the cores by cases.
_ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
#: Draws for each case that is wanted: not every law reaches every size on every joint.
_DRAWS = 6

#: Cells in which simpler ways are asked as well.
BASELINES = ("null", "one_3x", "one_1x", "outside")

Command = Callable[[Path, Case], dict[str, Any]]
#: Robot, mode, motion and what is hidden.
Place = tuple[str, str, str, Hidden]


def result(
    case: Case, command: Command = diagnose, keep: Path | None = None, baselines: bool = False
) -> dict[str, Any]:
    """Truth, answer and score of a case; its files go to ``keep``, if given."""
    with TemporaryDirectory() as temporary:
        folder = keep or Path(temporary)
        try:
            done = made(case)
        except RanAway as error:
            return {"case": case.record(), "skipped": str(error)}
        except OutOfReach as error:
            return {"case": case.record(), "skipped": str(error), "barren": asdict(error.hidden)}
        done.write(folder)
        start = time.perf_counter()
        answer = command(folder, case)
        seconds = time.perf_counter() - start
        record = {"case": case.record(), "truth": done.truth, "seconds": round(seconds, 1), "answer": answer}
        if "failed" in answer:
            return {**record, "failed": answer["failed"]}
        record["score"] = scored(done.truth, answer).record()
        if baselines:
            record["baselines"] = named_by_baselines(folder, case)
        return record


def folder_of_results(reserved: bool = True) -> Path:
    """The folder of RESULTS for the code as it is: what another code answered does not count.

    Cases of the development, without ``reserved`` laws, have one of their own: they are other draws.
    """
    return RESULTS / (state() + ("" if reserved else "_development"))


@dataclass(frozen=True)
class Plan:
    """``count`` cases of each of ``cells`` (with its mode), of which ``baselines`` are given to simpler ways too.

    No case begins after ``minutes``. Without ``reserved`` laws that are kept from the development are left out. Draws
    of a cell begin behind the last one whose name was ``asked`` before.
    """

    cells: tuple[tuple[str, str], ...]
    count: int
    baselines: int
    minutes: float = inf
    reserved: bool = True
    processes: int = 1
    asked: frozenset[str] = frozenset()

    def draws(self, cell: str, mode: str) -> Iterator[Case]:
        """The cases that may be asked of a cell, drawn as they are wanted where none was asked before."""
        drawn = islice(cases(cell, mode, self.reserved), _DRAWS * self.count)
        if not self.asked:
            return drawn
        every = list(drawn)
        return islice(every, max((i + 1 for i, one in enumerate(every) if one.name in self.asked), default=0), None)


def run(plan: Plan, folder: Path) -> Iterator[dict[str, Any]]:
    """Results of the plan's cases, made or read from earlier runs, as they come.

    Cells take turns, so that a study that is stopped has some of each. With several processes, which draws are left out
    as out of reach may differ by a few.
    """
    folder.mkdir(parents=True, exist_ok=True)
    end = time.monotonic() + 60 * plan.minutes
    counted = dict.fromkeys(plan.cells, 0)
    barren: set[Place] = set()
    queue = _queue(plan, counted, barren)
    running: set[Future[dict[str, Any]]] = set()
    os.environ |= _ONE_THREAD  # read where a process begins
    with ProcessPoolExecutor(plan.processes, get_context("spawn")) as pool:
        while True:
            room = plan.processes - len(running) if time.monotonic() < end else 0
            running |= {pool.submit(_kept, folder, *one) for one in islice(queue, room)}
            if not running:
                return
            ready, running = wait(running, return_when=FIRST_COMPLETED)
            for one in (future.result() for future in ready):
                if "skipped" not in one:
                    counted[one["case"]["cell"], one["case"]["mode"]] += 1
                elif "barren" in one:
                    barren.add(_place(case_of(one["case"]), Hidden(**one["barren"])))
                yield one


def _queue(plan: Plan, counted: Mapping[tuple[str, str], int], barren: Container[Place]) -> Iterator[tuple[Case, bool]]:
    """Cases by turns of the cells that want some, and whether simpler ways are asked.

    A law that did not reach its size in a place is not tried there again.
    """
    draws = {key: plan.draws(*key) for key in plan.cells}
    while draws:
        for key in list(draws):
            possible = (one for one in draws[key] if not any(_place(one, what) in barren for what in one.hidden))
            one = next(possible, None) if counted[key] < plan.count else None
            if one is None:
                del draws[key]
            else:
                yield one, counted[key] < plan.baselines


def _place(one: Case, what: Hidden) -> Place:
    return one.robot, one.mode, one.motion, what


def kept(folder: Path) -> list[dict[str, Any]]:
    """Every result that there is of the same code, whichever study made it."""
    files = sorted(folder.glob("*.json"))
    return [json.loads(file.read_text(encoding="utf-8")) for file in files]


def _kept(folder: Path, case: Case, baselines: bool) -> dict[str, Any]:
    file = folder / f"{case.name}.json"
    if file.exists():
        return dict(json.loads(file.read_text(encoding="utf-8")))
    try:
        done = result(case, baselines=baselines and case.cell in BASELINES)
    except (ValueError, ArithmeticError) as error:
        done = {"case": case.record(), "failed": f"{type(error).__name__}: {error}"}
    half = file.with_suffix(".part")
    half.write_text(json.dumps(done, indent=1) + "\n", encoding="utf-8")
    half.replace(file)
    return done
