"""Batch functions of the KR500-2MT: nanoseconds a sample, beside the memory's speed, Pinocchio and FIGAROH."""

from __future__ import annotations

import ctypes
import importlib.util
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.loops import peers
from benchmarks.table import table
from generator.generation import generate
from generator.python_library import build_library
from generator.reference.matter import INERTIAL
from generator.resources import find_robot
from generator.robot.readers import read
from tests.pinocchio_model import PinocchioArm
from tests.subject import Subject, subject

TITLE = "Many samples at once: observation matrices, normal equations, inverse dynamics"

ROBOT, SAMPLES, PASSES = "kr500", 1_000_000, 5
#: Results agree to this part of the largest entry, or the row says so.
_TOLERANCE = 1e-9
_PINOCCHIO = ("M", "MX", "MY", "MZ", "XX", "XY", "YY", "XZ", "YZ", "ZZ")
#: FIGAROH's blocks of columns behind the bodies'.
_FRICTION = ("Fv", "Fc", "Ia", "Off")

Array = NDArray[np.float64]


@dataclass
class Study:
    """The generated module, the samples, and the rows so far."""

    module: Any
    arm: Subject
    signals: tuple[Array, Array, Array]
    rows: list[dict[str, object]] = field(default_factory=list)

    def row(self, what: str, threads: int, ours: float, than: str, theirs: float, target: str, same: bool) -> None:
        """One comparison: nanoseconds a sample of both, and how many times as fast ours is."""
        self.rows.append(
            {
                "what": what,
                "threads": threads,
                "ns a sample": round(ours, 1),
                "compared with": than,
                "its ns": round(theirs, 1),
                "its ns / ours": round(theirs / ours, 2),
                "target": target,
                "same to 1e-9": "yes" if same else "NO",
            }
        )


def run(build: Path) -> dict[str, object]:
    """The rows of the study; ``build`` takes the generated code, the peers and FIGAROH's environment."""
    study = _study(build)
    notes = [
        f"{ROBOT}, {SAMPLES} samples, {study.module.NBASE} base parameters, {_compiler()}, -O2 -march=native",
        f"best of {PASSES} passes or more, all in one run; times include the call from Python; processor time on one "
        "thread, which other work on the machine disturbs least, the clock's on two",
        "write: a loop that stores one value into the same memory, which had been written before; the quicker of plain "
        "and non-temporal stores",
    ]
    _memory(study, build)
    _normal(study)
    _pinocchio(study, build)
    notes += _figaroh(study, build)
    notes += _strides(study)
    notes += _calls(study)
    return {"rows": study.rows, "notes": notes}


def _study(build: Path) -> Study:
    folder, _ = generate(find_robot(ROBOT), build / "generated")
    build_library(folder, ROBOT)
    specification = importlib.util.spec_from_file_location(ROBOT, folder / "python" / f"{ROBOT}.py")
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    signals = np.random.default_rng(1).uniform(-2.0, 2.0, (3, SAMPLES, module.NQ))
    return Study(module, subject(read(find_robot(ROBOT))), (signals[0], signals[1], signals[2]))


def _memory(study: Study, build: Path) -> None:
    """Observation matrices beside a write of the same memory, pass by pass in turns."""
    module, robot = study.module, study.module.Robot(study.arm.parameters)
    write = peers.stream_write(build)
    size = SAMPLES * module.NQ * module.NBASE
    memory = np.ones(size + 8)
    start = -(memory.ctypes.data // 8) % 8
    flat = memory[start : start + size]
    rows = flat.reshape(-1, module.NBASE)
    columns = flat.reshape(module.NBASE, -1).T
    for threads in (1, 2):
        _threads(threads)
        taken = _in_turns(
            threads,
            {
                "plain": lambda: write(flat.ctypes.data, flat.nbytes, 1.0, 0),
                "past": lambda: write(flat.ctypes.data, flat.nbytes, 1.0, 1),
                "columns": lambda: robot.observation_matrix(*study.signals, out=columns, layout="columns"),
                "rows": lambda: robot.observation_matrix(*study.signals, out=rows),
            },
        )
        least = min(taken["plain"], taken["past"])
        for layout in ("rows", "columns"):
            found = robot.observation_matrix(*(x[:1000] for x in study.signals), layout=layout)
            same = _same(found, _scalar(study, layout))
            study.row(f"observation_matrix, {layout}", threads, taken[layout], "write", least, "0.8", same)


def _normal(study: Study) -> None:
    """Inverse dynamics, Gram matrices, triangular factors and decimation on one and two threads."""
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
    calls: dict[str, tuple[Callable[[], object], bool]] = {
        "observation_gram": (lambda: robot.observation_gram(*study.signals, tau), _same(G, wanted)),
        "observation_qr": (
            lambda: robot.observation_qr(*study.signals, tau),
            _same(R.transpose(0, 2, 1) @ R, wanted),
        ),
        "observation_matrix, 101 taps, each 10th kept": (
            lambda: robot.observation_matrix(*study.signals, taps=taps, decimation=10),
            _same(filtered.reshape(len(convolved), -1), convolved),
        ),
    }
    one = dict.fromkeys(calls, 0.0)
    for threads in (1, 2):
        _threads(threads)
        taken = _in_turns(threads, {name: call for name, (call, _) in calls.items()}, passes=3)
        for name, (_, same) in calls.items():
            one[name] = one[name] or taken[name]
            study.row(name, threads, taken[name], "itself, 1 thread", one[name], "-", same)


def _pinocchio(study: Study, build: Path) -> None:
    """Beside Pinocchio's C++ loops, which leave the matrix in their own workspace."""
    arm = study.arm.only(*INERTIAL, "Ia")
    model = PinocchioArm(arm.robot, arm.values).model
    robot = study.module.Robot(arm.parameters)
    loop = peers.pinocchio(model, [x[:20000] for x in study.signals], build)
    first = [x[:200] for x in study.signals]
    W = robot.observation_matrix(*first).reshape(200, study.module.NQ, -1)
    names = {f"{stem}{j + 1}": 10 * j + k for j in range(study.module.NQ) for k, stem in enumerate(_PINOCCHIO)}
    kept = [(c, names[head]) for c, head in enumerate(arm.heads) if head in names]
    same_W = _same(W[:, :, [c for c, _ in kept]], loop.W[:, :, [c for _, c in kept]])
    same_tau = _same(robot.inverse_dynamics(*first), loop.tau)
    matrix = {str(row["what"]): row for row in study.rows if row["threads"] == 1}
    ours = float(str(matrix["observation_matrix, columns"]["ns a sample"]))
    study.row(
        "observation_matrix, columns",
        1,
        ours,
        "Pinocchio computeJointTorqueRegressor, C++",
        loop.regressor,
        "40",
        same_W,
    )
    torques = np.empty_like(study.signals[0])
    for threads in (1, 2):
        _threads(threads)
        taken = _in_turns(threads, {"tau": lambda: robot.inverse_dynamics(*study.signals, out=torques)}, passes=10)[
            "tau"
        ]
        study.row("inverse_dynamics", threads, taken, "Pinocchio rnea, C++", loop.inverse_dynamics, "60", same_tau)


def _figaroh(study: Study, build: Path) -> list[str]:
    """Beside FIGAROH, and beside a loop over Pinocchio's Python function."""
    n = 2000
    arm = study.arm
    first = [x[:n] for x in study.signals]
    try:
        found = peers.figaroh(PinocchioArm(arm.robot, arm.values).model, first, build)
    except RuntimeError as error:
        return [f"FIGAROH is not measured: {str(error).splitlines()[-1]}"]
    names = {f"{stem}{j + 1}": 10 * j + k for j in range(study.module.NQ) for k, stem in enumerate(_PINOCCHIO)}
    behind = 10 * study.module.NQ
    names |= {
        f"{stem}{j + 1}": behind + k * study.module.NQ + j
        for k, stem in enumerate(_FRICTION)
        for j in range(study.module.NQ)
    }
    kept = [(c, names[head]) for c, head in enumerate(arm.heads) if head in names]
    W = study.module.Robot(arm.parameters).observation_matrix(*first, layout="columns")
    same = _same(W[:, [c for c, _ in kept]], found["W"][:, [c for _, c in kept]])
    matrix = {(row["what"], row["threads"]): row for row in study.rows}
    ours = float(str(matrix["observation_matrix, columns", 1]["ns a sample"]))
    for than, theirs, target in (
        (f"FIGAROH {found['version']} build_regressor_basic", float(found["nanoseconds"]), "250"),
        ("Pinocchio computeJointTorqueRegressor, Python loop", float(found["loop"]), "-"),
    ):
        study.row("observation_matrix, columns", 1, ours, than, theirs, target, same)
    return []


def _strides(study: Study) -> list[str]:
    """What a stride of whole pages costs, for a matrix of columns that is not written past the caches."""
    module, robot = study.module, study.module.Robot(study.arm.parameters)
    _threads(1)
    n = 4096
    first = [x[:n] for x in study.signals]
    taken = {}
    for name, stride in (("page", n * module.NQ), ("good", n * module.NQ + 8)):
        out = np.ones((module.NBASE, stride))[:, : n * module.NQ].T
        taken[name] = _best(lambda out=out: robot.observation_matrix(*first, out=out, layout="columns"), 50) / n  # type: ignore[misc]
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

    return [f"inverse_dynamics of one state from Python, out= given: {_best(many, 5) / calls:.0f} ns a call"]


def _scalar(study: Study, layout: str) -> Array:
    """The matrix of the first thousand samples by the function for one state."""
    robot = study.module.Robot(study.arm.parameters)
    q, qd, qdd = (x[:1000] for x in study.signals)
    W = np.stack([robot.regressor(q[k], qd[k], qdd[k]) for k in range(1000)])
    ordered = W if layout == "rows" else W.transpose(1, 0, 2)
    return np.ascontiguousarray(ordered).reshape(-1, study.module.NBASE)


def _same(found: Array, wanted: Array) -> bool:
    return bool(np.abs(found - wanted).max() <= _TOLERANCE * np.abs(wanted).max())


def _in_turns(threads: int, calls: Mapping[str, Callable[[], object]], passes: int = PASSES) -> dict[str, float]:
    """Nanoseconds a sample of each, the best of its passes, which take turns."""
    taken = dict.fromkeys(calls, np.inf)
    clock = time.process_time if threads == 1 else time.perf_counter
    for _ in range(passes):
        for name, call in calls.items():
            taken[name] = min(taken[name], _best(call, 1, clock) / SAMPLES)
    return taken


def _best(call: Callable[[], object], passes: int, clock: Callable[[], float] = time.process_time) -> float:
    """Nanoseconds of the quickest pass."""
    times = []
    for _ in range(passes):
        begin = clock()
        call()
        times.append(clock() - begin)
    return 1e9 * min(times)


def _threads(count: int) -> None:
    ctypes.CDLL("libgomp.so.1").omp_set_num_threads(count)


def _compiler() -> str:
    words: Sequence[str] = subprocess.run(["cc", "--version"], capture_output=True, text=True, check=True).stdout.split(
        "\n"
    )
    return words[0]


if __name__ == "__main__":
    folder = Path(__file__).parents[2] / "build" / "bench" / "batch"
    folder.mkdir(parents=True, exist_ok=True)
    result = run(folder)
    print(table(result["rows"]))  # type: ignore[arg-type]
    print(*(f"- {note}" for note in result["notes"]), sep="\n")  # type: ignore[misc]
