"""The question put to the command line, with the files of a case and nothing else."""

from __future__ import annotations

import json
import signal
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from traceback import format_exc
from typing import Any

from benchmarks.diagnosis_study.case import KNOWN, Case
from benchmarks.diagnosis_study.runs import FITTED, NAMES
from generator.cli.main import main
from tests.plant.robot_file import PRIOR

#: Seconds after which a diagnosis counts as broken.
_PATIENCE = 600


def diagnose(folder: Path, case: Case) -> dict[str, Any]:
    """What ``counterpoise diagnose`` answers on the files in a folder; the last line of its complaint if it fails.

    The command runs in this process, so that a study of many cases loads the libraries once.
    """
    runs = [str(folder / f"{name}.csv") for name in NAMES]
    words = ["diagnose", str(folder / "robot.yaml"), *runs[:FITTED], "--validate", runs[FITTED], "--test", runs[-1]]
    if case.mode == KNOWN:
        words += ["--prior", PRIOR]
    out, said = folder / "out", StringIO()
    try:
        with redirect_stdout(StringIO()), redirect_stderr(said), _within(_PATIENCE):
            status: object = main([*words, "--out", str(out)])
    except Exception:  # whatever it is, it is the command's
        status = 1
        said.write(format_exc())
    if status:
        lines = said.getvalue().strip().splitlines()
        return {"failed": f"exit status {status}: {lines[-1] if lines else 'nothing said'}"}
    return dict(json.loads((out / "diagnosis.json").read_text(encoding="utf-8")))


@contextmanager
def _within(seconds: int) -> Iterator[None]:
    """Raises TimeoutError in what takes longer."""

    def stop(number: int, frame: object) -> None:
        raise TimeoutError(f"no answer within {seconds} s")

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
