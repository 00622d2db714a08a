"""Batch functions of the KR500-2MT: nanoseconds a sample, beside the memory's speed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.compiling import version
from benchmarks.loops import peers
from benchmarks.loops.chunks import (
    CHUNK,
    PASSES,
    PLACES,
    SAMPLES,
    agree,
    aligned,
    best,
    chunk,
    in_turns,
    on_threads,
    part,
    signals,
)
from benchmarks.loops.generated import loaded
from benchmarks.study import VOID, alone
from generator.generation import generate
from generator.python_library import build_library
from generator.resources import find_robot
from generator.robot.readers import read
from tests.subject import Subject, subject

TITLE = "Many samples at once: observation matrices, normal equations"

ROBOT = "kr500"

Array = NDArray[np.float64]


@dataclass
class Study:
    """The generated module, the samples, and the rows so far."""

    module: Any
    arm: Subject
    signals: tuple[Array, Array, Array]
    rows: list[dict[str, object]] = field(default_factory=list)

    def row(self, what: str, threads: int, ours: float, than: str, theirs: float, limit: str, same: bool) -> None:
        """One comparison: nanoseconds a sample of both, and how many times as fast ours is."""
        self.rows.append(
            {
                "what": what,
                "threads": threads,
                "ns a sample": round(ours, 1),
                "compared with": than,
                "its ns": round(theirs, 1),
                "its ns / ours": round(theirs / ours, 2) if same else VOID,
                "at least": limit,
            }
        )


def run(build: Path) -> dict[str, object]:
    """The rows of the study; ``build`` takes the generated code, the peers and FIGAROH's environment."""
    study = _study(build)
    stream, _ = peers.memory_and_loop(build)
    notes = [
        f"{ROBOT}, {SAMPLES} samples, {study.module.NBASE} base parameters, {version('cc')}, -O2 -march=native",
        f"the least of {PASSES} passes or more over all samples in chunks of {CHUNK}, in turn with what they "
        "are compared with, all in one run; times include the call from Python; processor time on one thread, which "
        "other work on the machine disturbs least, the clock's on two",
        "write: a loop that stores one value into the same memory, which had been written before; the quicker of plain "
        "and non-temporal stores",
    ]
    _memory(study, stream)
    _one_call(study, stream)
    _normal(study)
    notes += _strides(study)
    notes += _calls(study)
    return {"rows": study.rows, "notes": notes}


def _study(build: Path) -> Study:
    folder, _ = generate(find_robot(ROBOT), build / "generated")
    build_library(folder, ROBOT)
    module = loaded(folder, ROBOT)
    return Study(module, subject(read(find_robot(ROBOT))), signals(module.NQ))


def _memory(study: Study, stream: Any) -> None:
    """Observation matrices beside a write of the same memory, chunk by chunk in turns."""
    module, robot = study.module, study.module.Robot(study.arm.parameters)
    places = [aligned(CHUNK * module.NQ * module.NBASE) for _ in range(PLACES)]
    for threads in (1, 2):
        on_threads(threads)
        taken = in_turns(
            threads,
            {
                "plain": lambda k: stream(places[k % PLACES].ctypes.data, places[0].nbytes, 1.0, 0),
                "past": lambda k: stream(places[k % PLACES].ctypes.data, places[0].nbytes, 1.0, 1),
                "columns": lambda k: robot.observation_matrix(
                    *chunk(study.signals, k), out=places[k % PLACES].reshape(module.NBASE, -1).T, layout="columns"
                ),
                "rows": lambda k: robot.observation_matrix(
                    *chunk(study.signals, k), out=places[k % PLACES].reshape(-1, module.NBASE)
                ),
            },
        )
        least = min(taken["plain"], taken["past"])
        for layout in ("rows", "columns"):
            found = robot.observation_matrix(*(x[:1000] for x in study.signals), layout=layout)
            same = agree(found, _scalar(study, layout))
            study.row(f"observation_matrix, {layout}", threads, taken[layout], "write", least, "0.8", same)


def _one_call(study: Study, stream: Any) -> None:
    """The same by one call for all samples; the last of them is looked at."""
    module, robot = study.module, study.module.Robot(study.arm.parameters)
    on_threads(1)
    memory = aligned(SAMPLES * module.NQ * module.NBASE)
    rows, columns = memory.reshape(-1, module.NBASE), memory.reshape(module.NBASE, -1).T
    calls: dict[str, Callable[[], object]] = {
        "plain": lambda: stream(memory.ctypes.data, memory.nbytes, 1.0, 0),
        "past": lambda: stream(memory.ctypes.data, memory.nbytes, 1.0, 1),
        "rows": lambda: robot.observation_matrix(*study.signals, out=rows),
        "columns": lambda: robot.observation_matrix(*study.signals, out=columns, layout="columns"),
    }
    wanted = robot.regressor(*(x[-1] for x in study.signals))
    taken, same = dict.fromkeys(calls, np.inf), dict.fromkeys(calls, True)
    for _ in range(PASSES):
        for name, call in calls.items():
            taken[name] = min(taken[name], best(call, 1) / SAMPLES)
            last = rows[-module.NQ :] if name == "rows" else columns[SAMPLES - 1 :: SAMPLES]
            same[name] &= name not in ("rows", "columns") or agree(last, wanted)
    least = min(taken["plain"], taken["past"])
    for layout in ("rows", "columns"):
        what = f"observation_matrix, {layout}, one call"
        study.row(what, 1, taken[layout], "write", least, "0.8", same[layout])


def _normal(study: Study) -> None:
    """Gram matrices, triangular factors and decimation on one and two threads."""
    module, robot = study.module, study.module.Robot(study.arm.parameters)
    tau = robot.inverse_dynamics(*study.signals)
    taps = np.hanning(103)[1:-1] / np.hanning(103).sum()
    short = [x[:2000] for x in (*study.signals, tau)]
    G, R = robot.observation_gram(*short), robot.observation_qr(*short)
    W = robot.observation_matrix(*short[:3]).reshape(2000, module.NQ, -1)
    stacked = np.concatenate([W, short[3][:, :, None]], axis=2).transpose(1, 0, 2)
    wanted = stacked.transpose(0, 2, 1) @ stacked
    filtered = robot.observation_matrix(*short[:3], taps=taps, decimation=10)
    convolved = np.stack([np.convolve(c, taps, "valid")[::10] for c in W.reshape(2000, -1).T], axis=-1)
    calls: dict[str, tuple[Callable[[int], object], bool]] = {
        "observation_gram": (
            lambda k: robot.observation_gram(*chunk(study.signals, k), tau[part(k)]),
            agree(G, wanted),
        ),
        "observation_qr": (
            lambda k: robot.observation_qr(*chunk(study.signals, k), tau[part(k)]),
            agree(R.transpose(0, 2, 1) @ R, wanted),
        ),
        "observation_matrix, 101 taps, each 10th kept": (
            lambda k: robot.observation_matrix(*chunk(study.signals, k), taps=taps, decimation=10),
            agree(filtered.reshape(len(convolved), -1), convolved),
        ),
    }
    one = dict.fromkeys(calls, 0.0)
    for threads in (1, 2):
        on_threads(threads)
        taken = in_turns(threads, {name: call for name, (call, _) in calls.items()}, passes=1)
        for name, (_, same) in calls.items():
            one[name] = one[name] or taken[name]
            study.row(name, threads, taken[name], "itself, 1 thread", one[name], "-", same)


def _strides(study: Study) -> list[str]:
    """What a stride of whole pages costs, for a matrix of columns that is not written past the caches."""
    module, robot = study.module, study.module.Robot(study.arm.parameters)
    on_threads(1)
    n = 4096
    first = [x[:n] for x in study.signals]
    taken = {}
    for name, stride in (("page", n * module.NQ), ("good", n * module.NQ + 8)):
        out = np.ones((module.NBASE, stride))[:, : n * module.NQ].T
        taken[name] = best(lambda out=out: robot.observation_matrix(*first, out=out, layout="columns"), 50) / n  # type: ignore[misc]
    page, good = taken["page"], taken["good"]
    return [
        f"columns of {n} samples, 1 thread: {page:.0f} ns a sample with a stride of whole pages, "
        f"{good:.0f} ns with one more line"
    ]


def _calls(study: Study) -> list[str]:
    """What a call for one state costs from Python, its result in place."""
    robot = study.module.Robot(study.arm.parameters)
    state = [np.ascontiguousarray(x[0]) for x in study.signals]
    tau = np.empty(study.module.NQ)
    calls = 20000

    def many() -> None:
        for _ in range(calls):
            robot.inverse_dynamics(*state, out=tau)

    return [f"inverse_dynamics of one state from Python, out= given: {best(many, 5) / calls:.0f} ns a call"]


def _scalar(study: Study, layout: str) -> Array:
    """The matrix of the first thousand samples by the function for one state."""
    robot = study.module.Robot(study.arm.parameters)
    q, qd, qdd = (x[:1000] for x in study.signals)
    W = np.stack([robot.regressor(q[k], qd[k], qdd[k]) for k in range(1000)])
    ordered = W if layout == "rows" else W.transpose(1, 0, 2)
    return np.ascontiguousarray(ordered).reshape(-1, study.module.NBASE)


if __name__ == "__main__":
    import benchmarks.studies.batch as study

    alone(__file__, study)
