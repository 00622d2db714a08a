"""Batch functions of the KR500-2MT: nanoseconds a sample, beside the memory's speed, Pinocchio and FIGAROH."""

from __future__ import annotations

import ctypes
import importlib.util
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.compiling import version
from benchmarks.loops import peers
from benchmarks.study import VOID, alone
from generator.generation import generate
from generator.python_library import build_library
from generator.reference.matter import INERTIAL
from generator.resources import find_robot
from generator.robot.readers import read
from tests.pinocchio_model import PinocchioArm
from tests.subject import Subject, subject

TITLE = "Many samples at once: observation matrices, normal equations, inverse dynamics"

#: Samples are computed chunk by chunk, each timed, into one of PLACES places in memory in turn: a chunk's matrix is
#: larger than the last cache, and a short one is more likely to be left alone by other work on the machine.
ROBOT, SAMPLES, CHUNK, PLACES, PASSES = "kr500", 1_000_000, 20_000, 4, 4
#: Results agree to this part of the largest entry, or the row is void.
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

    def taken(self, what: str, threads: int) -> float:
        """Nanoseconds a sample of a row."""
        row = next(row for row in self.rows if (row["what"], row["threads"]) == (what, threads))
        return float(str(row["ns a sample"]))


def run(build: Path) -> dict[str, object]:
    """The rows of the study; ``build`` takes the generated code, the peers and FIGAROH's environment."""
    study = _study(build)
    stream, loop = peers.memory_and_loop(build)
    notes = [
        f"{ROBOT}, {SAMPLES} samples, {study.module.NBASE} base parameters, {version('cc')}, -O2 -march=native",
        f"the least of {PASSES} passes or more over all samples in chunks of {CHUNK}, in turn with what they "
        "are compared with, all in one run; times include the call from Python; processor time on one thread, which "
        "other work on the machine disturbs least, the clock's on two; Pinocchio and FIGAROH run on one thread",
        "write: a loop that stores one value into the same memory, which had been written before; the quicker of plain "
        "and non-temporal stores",
    ]
    _memory(study, stream)
    _one_call(study, stream)
    _normal(study)
    notes += _pinocchio(study, loop, build)
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


def _memory(study: Study, stream: Any) -> None:
    """Observation matrices beside a write of the same memory, chunk by chunk in turns."""
    module, robot = study.module, study.module.Robot(study.arm.parameters)
    places = [_aligned(CHUNK * module.NQ * module.NBASE) for _ in range(PLACES)]
    for threads in (1, 2):
        _threads(threads)
        taken = _in_turns(
            threads,
            {
                "plain": lambda k: stream(places[k % PLACES].ctypes.data, places[0].nbytes, 1.0, 0),
                "past": lambda k: stream(places[k % PLACES].ctypes.data, places[0].nbytes, 1.0, 1),
                "columns": lambda k: robot.observation_matrix(
                    *_chunk(study, k), out=places[k % PLACES].reshape(module.NBASE, -1).T, layout="columns"
                ),
                "rows": lambda k: robot.observation_matrix(
                    *_chunk(study, k), out=places[k % PLACES].reshape(-1, module.NBASE)
                ),
            },
        )
        least = min(taken["plain"], taken["past"])
        for layout in ("rows", "columns"):
            found = robot.observation_matrix(*(x[:1000] for x in study.signals), layout=layout)
            same = _same(found, _scalar(study, layout))
            study.row(f"observation_matrix, {layout}", threads, taken[layout], "write", least, "0.8", same)


def _one_call(study: Study, stream: Any) -> None:
    """The same by one call for all samples; the last of them is looked at."""
    module, robot = study.module, study.module.Robot(study.arm.parameters)
    _threads(1)
    memory = _aligned(SAMPLES * module.NQ * module.NBASE)
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
            taken[name] = min(taken[name], _best(call, 1) / SAMPLES)
            last = rows[-module.NQ :] if name == "rows" else columns[SAMPLES - 1 :: SAMPLES]
            same[name] &= name not in ("rows", "columns") or _same(last, wanted)
    least = min(taken["plain"], taken["past"])
    for layout in ("rows", "columns"):
        what = f"observation_matrix, {layout}, one call"
        study.row(what, 1, taken[layout], "write", least, "0.8", same[layout])


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
    calls: dict[str, tuple[Callable[[int], object], bool]] = {
        "observation_gram": (lambda k: robot.observation_gram(*_chunk(study, k), tau[_part(k)]), _same(G, wanted)),
        "observation_qr": (
            lambda k: robot.observation_qr(*_chunk(study, k), tau[_part(k)]),
            _same(R.transpose(0, 2, 1) @ R, wanted),
        ),
        "observation_matrix, 101 taps, each 10th kept": (
            lambda k: robot.observation_matrix(*_chunk(study, k), taps=taps, decimation=10),
            _same(filtered.reshape(len(convolved), -1), convolved),
        ),
    }
    one = dict.fromkeys(calls, 0.0)
    for threads in (1, 2):
        _threads(threads)
        taken = _in_turns(threads, {name: call for name, (call, _) in calls.items()}, passes=1)
        for name, (_, same) in calls.items():
            one[name] = one[name] or taken[name]
            study.row(name, threads, taken[name], "itself, 1 thread", one[name], "-", same)


def _pinocchio(study: Study, loop: Any, build: Path) -> list[str]:
    """Beside a loop over Pinocchio's C++ functions, which leave the matrix in their own workspace."""
    module, arm = study.module, study.arm.only(*INERTIAL, "Ia")
    loops = peers.pinocchio(PinocchioArm(arm.robot, arm.values).model, loop, build)
    robot = module.Robot(arm.parameters)
    first = [x[:200] for x in study.signals]
    W, tau = np.empty((200, module.NQ, 10 * module.NQ)), np.empty((200, module.NQ))
    ours = robot.observation_matrix(*first).reshape(200, module.NQ, -1)
    names = {f"{stem}{j + 1}": 10 * j + k for j in range(module.NQ) for k, stem in enumerate(_PINOCCHIO)}
    kept = [(c, names[head]) for c, head in enumerate(arm.heads) if head in names]
    same = {"regressor": True, "inverse_dynamics": True}
    for each in loops:
        each("regressor", first, W)
        each("inverse_dynamics", first, tau)
        same["regressor"] &= _same(ours[:, :, [c for c, _ in kept]], W[:, :, [c for _, c in kept]])
        same["inverse_dynamics"] &= _same(robot.inverse_dynamics(*first), tau)
    short = [x[:2000] for x in study.signals]
    torques = np.empty((CHUNK, module.NQ))
    theirs = {(each.compiler, name): np.inf for each in loops for name in same}
    taken = {1: np.inf, 2: np.inf}
    for _ in range(5):
        for each in loops:
            for name in same:
                nanoseconds = _best(lambda each=each, name=name: each(name, short), 4) / 2000  # type: ignore[misc]
                theirs[each.compiler, name] = min(theirs[each.compiler, name], nanoseconds)
        for threads in taken:
            _threads(threads)
            calls = {"tau": lambda k: robot.inverse_dynamics(*_chunk(study, k), out=torques)}
            taken[threads] = min(taken[threads], _in_turns(threads, calls, 1)["tau"])
    least = {name: min(theirs[each.compiler, name] for each in loops) for name in same}
    for threads, ns in taken.items():
        matrix = study.taken("observation_matrix, columns", threads)
        than = "Pinocchio computeJointTorqueRegressor, C++"
        study.row("observation_matrix, columns", threads, matrix, than, least["regressor"], "40", same["regressor"])
        than = "Pinocchio rnea, C++"
        study.row("inverse_dynamics", threads, ns, than, least["inverse_dynamics"], "60", same["inverse_dynamics"])
    told = ", ".join(f"{name} {compiler} {ns:.0f}" for (compiler, name), ns in theirs.items())
    return [f"Pinocchio by each compiler, ns a sample, of which the table has the least: {told}"]


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
    for threads in (1, 2):
        ours = study.taken("observation_matrix, columns", threads)
        for than, theirs, limit in (
            (f"FIGAROH {found['version']} build_regressor_basic", float(found["nanoseconds"]), "250"),
            ("Pinocchio computeJointTorqueRegressor, Python loop", float(found["loop"]), "-"),
        ):
            study.row("observation_matrix, columns", threads, ours, than, theirs, limit, same)
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


def _in_turns(threads: int, calls: Mapping[str, Callable[[int], object]], passes: int = PASSES) -> dict[str, float]:
    """Nanoseconds a sample of each, the least of its calls for each chunk, which take turns."""
    taken = dict.fromkeys(calls, np.inf)
    clock = time.process_time if threads == 1 else time.perf_counter
    for k in range(passes * SAMPLES // CHUNK):
        for name, call in calls.items():
            taken[name] = min(taken[name], _best(lambda call=call, k=k: call(k), 1, clock) / CHUNK)  # type: ignore[misc]
    return taken


def _part(k: int) -> slice:
    begin = k * CHUNK % SAMPLES
    return slice(begin, begin + CHUNK)


def _chunk(study: Study, k: int) -> list[Array]:
    return [x[_part(k)] for x in study.signals]


def _aligned(size: int) -> Array:
    """Memory that has been written before and begins on a multiple of 64 bytes."""
    memory = np.ones(size + 8)
    start = -(memory.ctypes.data // 8) % 8
    return memory[start : start + size]


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


if __name__ == "__main__":
    import benchmarks.studies.batch as itself

    alone(__file__, itself)
