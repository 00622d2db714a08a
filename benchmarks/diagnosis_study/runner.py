"""Cases run: made, given to the command line, scored; a result file each, so that a study can go on where it was."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from hashlib import sha256
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.diagnosis_study.baselines import named_by_baselines
from benchmarks.diagnosis_study.case import KNOWN, Case
from benchmarks.diagnosis_study.drawing import cases
from benchmarks.diagnosis_study.making import made
from benchmarks.diagnosis_study.runs import FITTED, NAMES
from benchmarks.diagnosis_study.scoring import scored
from benchmarks.diagnosis_study.sizing import OutOfReach
from tests.plant.robot_file import PRIOR

ROOT = Path(__file__).parents[2]
#: Where results of cases are kept, by the code that they came from.
RESULTS = ROOT / "build" / "diagnosis_study"
#: What a result depends on.
_SOURCES = ("generator", "identification", "tests/plant", "benchmarks/diagnosis_study")
#: Largest mismatch of a null case, in multiples of the noise: cases above are scored apart.
MISMATCH = 0.05
#: Seconds after which a diagnosis counts as broken.
_PATIENCE = 600
#: Draws for each case that is wanted: not every law reaches every size on every joint.
_DRAWS = 6

#: Cells in which simpler ways are asked as well.
BASELINES = ("null", "one_3x", "one_1x", "outside")

Command = Callable[[Path, Case], dict[str, Any]]


def diagnose(folder: Path, case: Case) -> dict[str, Any]:
    """What ``counterpoise diagnose`` answers on the files in a folder; the last line of its complaint if it fails."""
    runs = [str(folder / f"{name}.csv") for name in NAMES]
    words = ["diagnose", str(folder / "robot.yaml"), *runs[:FITTED], "--validate", runs[FITTED], "--test", runs[-1]]
    if case.mode == KNOWN:
        words += ["--prior", PRIOR]
    out = folder / "out"
    done = subprocess.run(
        [sys.executable, "-m", "generator", *words, "--out", str(out)],
        capture_output=True,
        text=True,
        timeout=_PATIENCE,
        check=False,
    )
    if done.returncode:
        lines = done.stderr.strip().splitlines()
        return {"failed": f"exit status {done.returncode}: {lines[-1] if lines else 'nothing said'}"}
    return dict(json.loads((out / "diagnosis.json").read_text(encoding="utf-8")))


def result(case: Case, command: Command = diagnose, keep: Path | None = None) -> dict[str, Any]:
    """Truth, answer and score of a case; its files go to ``keep``, if given."""
    with TemporaryDirectory() as temporary:
        folder = keep or Path(temporary)
        try:
            done = made(case)
        except (OutOfReach, ValueError) as error:
            return {"case": case.record(), "skipped": str(error)}
        done.write(folder)
        start = time.perf_counter()
        answer = command(folder, case)
        seconds = time.perf_counter() - start
        record = {"case": case.record(), "truth": done.truth, "seconds": round(seconds, 1), "answer": answer}
        if "failed" in answer:
            return {**record, "failed": answer["failed"]}
        record["score"] = scored(done.truth, answer).record()
        if case.cell in BASELINES:
            record["baselines"] = named_by_baselines(folder, case)
        if keep is None:
            shutil.rmtree(folder / "out", ignore_errors=True)
        return record


def folder_of_results() -> Path:
    """The folder of RESULTS for the code as it is: what another code answered does not count."""
    digest = sha256()
    for source in _SOURCES:
        for file in sorted((ROOT / source).rglob("*")):
            if file.suffix in (".py", ".c", ".in", ".h", ".json"):
                digest.update(file.read_bytes())
    return RESULTS / digest.hexdigest()[:16]


def run(cells: list[tuple[str, str]], count: int, reserved: bool, processes: int = 1) -> Iterator[dict[str, Any]]:
    """Results of ``count`` cases of each cell and mode, made or read from earlier runs, as they come.

    Cells take turns, so that a study that is stopped has some of each.
    """
    kept = folder_of_results()
    kept.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(processes) as pool:
        drawn = {key: list(islice(cases(*key, reserved), _DRAWS * count)) for key in cells}
        counted = dict.fromkeys(cells, 0)
        for attempt in range(_DRAWS * count):
            wanted = [drawn[key][attempt] for key in cells if counted[key] < count]
            if not wanted:
                return
            for one in pool.map(partial(_kept, kept), wanted):
                if "skipped" not in one:
                    counted[one["case"]["cell"], one["case"]["mode"]] += 1
                yield one


def _kept(folder: Path, case: Case) -> dict[str, Any]:
    file = folder / f"{case.name}.json"
    if file.exists():
        return dict(json.loads(file.read_text(encoding="utf-8")))
    try:
        done = result(case)
    except subprocess.TimeoutExpired:
        done = {"case": case.record(), "failed": f"no answer within {_PATIENCE} s"}
    half = file.with_suffix(".part")
    half.write_text(json.dumps(done, indent=1) + "\n", encoding="utf-8")
    half.replace(file)
    return done
