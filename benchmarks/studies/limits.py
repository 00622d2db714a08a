"""Many samples beside Pinocchio and FIGAROH, and how fast the machine lets any code be that does the same work."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.loops import arithmetic, generated, peers
from benchmarks.loops.chunks import (
    CHUNK,
    PLACES,
    Array,
    agree,
    aligned,
    best,
    chunk,
    in_turns,
    on_threads,
    signals,
)
from benchmarks.study import VOID, alone
from benchmarks.variants import variant
from generator.reference.matter import INERTIAL
from tests.bodies import PINOCCHIO
from tests.pinocchio_model import PinocchioArm
from tests.subject import Subject, subject

TITLE = "Many samples beside other libraries and the machine's limits"

ROBOT = "kr500"
#: What the other libraries model too, and all that the robot has.
_VARIANTS: dict[str, set[str] | None] = {"bodies and rotors": {"rotor_inertia"}, "whole robot": None}
_DYNAMICS, _MATRIX = "inverse_dynamics", "observation_matrix"
#: The functions of the generated C that do the arithmetic of each.
_FUNCTIONS = {_DYNAMICS: (f"{ROBOT}_batch_inverse_dynamics",), _MATRIX: ("regressor_lanes", "evaluate")}
_THREADS = (1, 2)
_ROUNDS = 5
_SHORT = 2000
#: FIGAROH's blocks of columns behind the bodies'.
_FRICTION = ("Fv", "Fc", "Ia", "Off")


@dataclass
class Measured:
    """A variant of the robot: nanoseconds a sample of ours and of the machine's limits, by function and threads."""

    modules: dict[str, Any]
    arm: Subject
    signals: tuple[Array, Array, Array]
    ours: dict[tuple[str, int], float] = field(default_factory=dict)
    limits: dict[tuple[str, int], tuple[float, str]] = field(default_factory=dict)

    @property
    def module(self) -> Any:
        """The module by one compiler; the results are looked at with it."""
        return next(iter(self.modules.values()))

    def take(self, function: str, threads: int, nanoseconds: float) -> None:
        """Keeps the least."""
        self.ours[function, threads] = min(nanoseconds, self.ours.get((function, threads), np.inf))

    def found(self, count: int) -> tuple[Array, Array]:
        """Observation matrix (count x joints x columns) and torques (count x joints) of the first samples."""
        robot = self.module.Robot(self.arm.parameters)
        first = [x[:count] for x in self.signals]
        return robot.observation_matrix(*first).reshape(count, self.module.NQ, -1), robot.inverse_dynamics(*first)


def run(build: Path) -> dict[str, object]:
    """A row for each function, variant, number of threads and library."""
    stream, loop = peers.memory_and_loop(build)
    measured = {name: _variant(name, effects, build) for name, effects in _VARIANTS.items()}
    notes = [_machine(measured, stream, build)]
    rows = []
    theirs, same, told = _pinocchio(measured, loop, build)
    notes.append(told)
    for function, than, asked in ((_DYNAMICS, "Pinocchio rnea, C++", 60.0), (_MATRIX, "Pinocchio, C++", 40.0)):
        for name, one in measured.items():
            rows += _rows(one, name, function, than, theirs[function], asked, same[name, function])
    try:
        figaroh = _figaroh(measured["whole robot"], build)
    except RuntimeError as error:
        notes.append(f"FIGAROH is not measured: {str(error).splitlines()[-1]}")
    else:
        rows += _rows(measured["whole robot"], "whole robot", _MATRIX, *figaroh)
    return {"rows": rows, "notes": notes}


def _variant(name: str, effects: set[str] | None, build: Path) -> Measured:
    arm = subject(variant(ROBOT, effects))
    modules = generated.modules(arm.model, build / name.replace(" ", "_"))
    return Measured(modules, arm, signals(arm.dof))


def _machine(measured: dict[str, Measured], stream: Any, build: Path) -> str:
    """Ours and the machine's limits, in turns; tells the machine's."""
    told = []
    for threads in _THREADS:
        on_threads(threads)
        rates = arithmetic.rates(
            build, lambda call, k=threads: CHUNK * in_turns(k, {"": lambda _: call()})[""], threads
        )  # type: ignore[misc]
        told.append(
            f"{threads} thread{'s' * (threads > 1)}: {rates.products:.1f} vector instructions a ns that multiply or "
            f"fuse, {rates.sums:.1f} that add, {rates.both:.1f} of both kinds"
        )
        for name, one in measured.items():
            size = one.module.NQ * one.module.NBASE
            places = [aligned(CHUNK * size) for _ in range(PLACES)]
            write = _in_turns(one, stream, places, threads)
            source = build / name.replace(" ", "_") / next(iter(one.modules)) / ROBOT
            for function, functions in _FUNCTIONS.items():
                work = arithmetic.work(source / "batch" / f"{ROBOT}_batch.c", source / "c", functions, build / name[:5])
                limit = (rates.least(work), f"arithmetic: {work.total} instructions for {work.lanes} samples")
                if function == _MATRIX:
                    limit = max(limit, (write, f"write: {8 * size} bytes a sample"))
                one.limits[function, threads] = limit
    return "; ".join(told)


def _in_turns(one: Measured, stream: Any, places: list[Array], threads: int) -> float:
    """Measures ours by every compiler; the nanoseconds a sample of a write of the matrix's bytes."""
    torques = np.empty((CHUNK, one.module.NQ))
    calls: dict[str, Callable[[int], object]] = {
        "write": lambda k: stream(places[k % PLACES].ctypes.data, places[0].nbytes, 1.0, 1)
    }
    for compiler, module in one.modules.items():
        robot = module.Robot(one.arm.parameters)
        calls[f"{_DYNAMICS} {compiler}"] = lambda k, robot=robot: robot.inverse_dynamics(  # type: ignore[misc]
            *chunk(one.signals, k), out=torques
        )
        calls[f"{_MATRIX} {compiler}"] = lambda k, robot=robot: robot.observation_matrix(  # type: ignore[misc]
            *chunk(one.signals, k), out=places[k % PLACES].reshape(-1, one.module.NBASE)
        )
    taken = in_turns(threads, calls)
    for what, nanoseconds in taken.items():
        if what != "write":
            one.take(what.split()[0], threads, nanoseconds)
    return taken["write"]


def _pinocchio(
    measured: dict[str, Measured], loop: Any, build: Path
) -> tuple[dict[str, float], dict[tuple[str, str], bool], str]:
    """Pinocchio's times by function, whether its results are those of each variant, and its compilers' times."""
    first = next(iter(measured.values()))
    arm = first.arm.only(*INERTIAL, "Ia")
    loops = peers.pinocchio(PinocchioArm(arm.robot, arm.values).model, loop, build)
    called = {_DYNAMICS: "inverse_dynamics", _MATRIX: "regressor"}
    short = [x[:_SHORT] for x in first.signals]
    times = {
        (function, each.compiler): min(
            best(lambda each=each, name=name: each(name, short), 4) / _SHORT  # type: ignore[misc]
            for _ in range(_ROUNDS)
        )
        for function, name in called.items()
        for each in loops
    }
    same = {}
    for variant_name, one in measured.items():
        few = [x[:200] for x in one.signals]
        bodies = one.arm.with_values(arm.values)
        W, tau = np.empty((200, one.arm.dof, 10 * one.arm.dof)), np.empty((200, one.arm.dof))
        matrix, _ = one.found(200)
        torques = one.module.Robot(bodies.parameters).inverse_dynamics(*few)
        kept = _columns(one, {stem: k for k, stem in enumerate(PINOCCHIO)})
        for each in loops:
            each("regressor", few, W)
            each("inverse_dynamics", few, tau)
            agrees = agree(matrix[:, :, [c for c, _ in kept]], W[:, :, [c for _, c in kept]])
            same[variant_name, _MATRIX] = agrees and same.get((variant_name, _MATRIX), True)
            same[variant_name, _DYNAMICS] = agree(torques, tau) and same.get((variant_name, _DYNAMICS), True)
    least = {function: min(ns for (name, _), ns in times.items() if name == function) for function in called}
    told = ", ".join(f"{called[function]} {compiler} {ns:.0f}" for (function, compiler), ns in times.items())
    return (
        least,
        same,
        f"Pinocchio by each compiler, ns a sample on one thread, of which the table has the least: {told}",
    )


def _columns(one: Measured, places: dict[str, int]) -> list[tuple[int, int]]:
    """Columns of our matrix, and where the bodies' parameters that they stand for are, ten a body."""
    names = {f"{stem}{j + 1}": 10 * j + k for j in range(one.arm.dof) for stem, k in places.items()}
    return [(c, names[head]) for c, head in enumerate(one.arm.heads) if head in names]


def _figaroh(one: Measured, build: Path) -> tuple[str, float, float, bool]:
    """FIGAROH's name, its time, what is asked, and whether its results are ours."""
    first, n = [x[:_SHORT] for x in one.signals], one.arm.dof
    found = peers.figaroh(PinocchioArm(one.arm.robot, one.arm.values).model, first, build)
    names = {f"{stem}{j + 1}": (10 + k) * n + j for j in range(n) for k, stem in enumerate(_FRICTION)}
    kept = _columns(one, {stem: k for k, stem in enumerate(PINOCCHIO)})
    kept += [(c, names[head]) for c, head in enumerate(one.arm.heads) if head in names]
    W = one.module.Robot(one.arm.parameters).observation_matrix(*first, layout="columns")
    same = agree(W[:, [c for c, _ in kept]], found["W"][:, [c for _, c in kept]])
    return f"FIGAROH {found['version']}", float(found["nanoseconds"]), 250.0, same


def _rows(
    one: Measured, name: str, function: str, than: str, theirs: float, asked: float, same: bool
) -> list[dict[str, object]]:
    """One comparison on one thread and on more; the other library runs on one."""
    rows: list[dict[str, object]] = []
    for threads in _THREADS:
        ours, (limit, what) = one.ours[function, threads], one.limits[function, threads]
        rows.append(
            {
                "what": f"{function}, {name}",
                "threads": threads,
                "ns a sample": round(ours, 1),
                "compared with": than,
                "its ns": round(theirs, 1),
                "its ns / ours": round(theirs / ours, 1) if same else VOID,
                "asked": asked,
                "at most": round(theirs / limit, 1),
                "share of that": f"{100 * limit / ours:.0f} %",
                "limit": what,
            }
        )
    return rows


if __name__ == "__main__":
    import benchmarks.studies.limits as study

    alone(__file__, study)
