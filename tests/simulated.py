"""The generated simulation made callable: compiled with its library, bound by cffi, arrays of numpy in and out."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from generator.backends import c as c_backend
from generator.backends import simulation as simulation_backend
from generator.backends.printing.runge_kutta import METHODS, Method
from generator.resources import find_robot
from generator.robot.readers import read
from generator.symbolic.model import Model
from tests.bound import Bound
from tests.compiled import SHARED, run, write
from tests.subject import Subject, subject

Vector = NDArray[np.float64]

QUANTITIES = (
    "direct_dynamics_sliding",
    "direct_dynamics_smooth",
    "flexible_direct_dynamics_sliding",
    "flexible_direct_dynamics_smooth",
    "joint_torque",
    "kinetic_energy",
    "motor_position",
    "motor_speed",
    "motor_torque",
    "potential_energy",
)
#: Robot and plant: wrist coupling and balancers, a prismatic axis beside a rigid one, a tree.
PLANTS = [
    pytest.param("kr500", "rigid", marks=pytest.mark.long),
    ("kr500", "flexible"),
    pytest.param("kr270", "flexible", marks=pytest.mark.long),
    ("scara", "rigid"),
    ("scara", "flexible"),
    ("tree_two_arms", "rigid"),
]


@cache
def arm(name: str) -> Subject:
    return subject(read(find_robot(name)), names=QUANTITIES)


def state_of(of: Subject, plant: str, seed: int = 3) -> tuple[Vector, Vector]:
    """Positions with small elongations, and speeds that keep their signs for a while."""
    q, qd, _ = of.state(seed)
    if plant == "rigid":
        return q, qd
    elastic = len(of.model.elastic)
    return np.concatenate([q, np.full(elastic, 1e-3)]), np.concatenate([qd, np.zeros(elastic)])


def positions(state: Any) -> Vector:
    return np.array(list(state.q))


#: Compiles a simulation of a subject: its plant, and flags of the compiler.
Make = Callable[..., "Simulation"]


def maker(folder: Path) -> Make:
    """Makes simulations in folders of their own below ``folder``; those of one model with the same flags share one."""
    kept: dict[tuple[Model, tuple[str, ...]], Bound] = {}

    def made(of: Subject, plant: str = "rigid", *flags: str) -> Simulation:
        if (of.model, flags) not in kept:
            place = folder / str(len(list(folder.iterdir())))
            place.mkdir()
            kept[of.model, flags] = compiled(of.model, place, ("-O1", *flags))
        return Simulation(of.model, kept[of.model, flags], of.parameters, plant)

    return made


def emit(model: Model, folder: Path, methods: Sequence[Method] = METHODS) -> Path:
    """Writes library and simulation of ``model``; returns ``folder``."""
    write(folder / "c", c_backend.library(model, ()))
    write(folder / "simulation", simulation_backend.sources(model, methods))
    return folder


def compiled(model: Model, folder: Path, flags: Sequence[str], methods: Sequence[Method] = METHODS) -> Bound:
    """Library and simulation of ``model``, written to ``folder`` and compiled."""
    name, include = model.robot.name, f"-I{folder / 'c'}"
    emit(model, folder, methods)
    library = folder / f"lib{name}{len(list(folder.iterdir()))}.so"
    sources = [folder / "c" / f"{name}.c", folder / "simulation" / f"{name}_simulation.c"]
    run(["gcc", "-std=c99", *SHARED, *flags, include, *sources, "-o", library, "-lm"])
    header = folder / "simulation" / f"{name}_simulation.h"
    return Bound(name, library, header, ["-D__STDC_HOSTED__=1", *flags, include])


@dataclass(frozen=True)
class Gains:
    """Of the cascade, one number or one per motor each; see the generated header."""

    kp: ArrayLike
    kv: ArrayLike
    ki: ArrayLike
    limit: ArrayLike
    period: float = 1e-3


@dataclass
class Run:
    """A closed loop's log, one row a sample."""

    q: Vector
    qd: Vector
    tau: Vector
    done: int
    state: Any
    seconds: float


@dataclass
class Simulation:
    """The compiled simulation of one robot: ``plant`` is rigid or flexible, ``size`` its number of coordinates."""

    model: Model
    code: Bound
    parameters: Vector
    plant: str = "rigid"

    def __post_init__(self) -> None:
        """Prepares the parameters."""
        self.macro = self.model.robot.name.upper()
        self.n = self.model.dof
        self.size = self.n if self.plant == "rigid" else self.model.flexible_dof
        self.real = np.dtype(f"f{self.code.ffi.sizeof(f'{self.model.robot.name}_real')}")
        self.prepared = self.code.new("prepared *")
        params = self.code.new("params *")
        params.value = [float(value) for value in self.parameters]
        self.code.call("prepare", params, self.prepared)

    def start(self, q: ArrayLike, qd: ArrayLike) -> Any:
        """A new state."""
        state = self.code.new(f"{self.plant}_state *")
        self.code.call(f"{self.plant}_start", self.prepared, self.code.array(q), self.code.array(qd), state)
        return state

    def integration(self, method: str = "RK4", steps: int = 1, width: ArrayLike | None = None) -> Any:
        """How to integrate; without a width with sign friction."""
        result = self.code.new("integration *")
        result.method = getattr(self.code.library, f"{self.macro}_METHOD_{method}")
        result.steps = steps
        if width is not None:
            self._kept = self.code.array(np.broadcast_to(np.asarray(width, float), self.size))
            result.width = self._kept
        return result

    def advance(
        self, state: Any, integration: Any, seconds: float, tau: ArrayLike, tau_ext: ArrayLike | None = None
    ) -> Any:
        """Moves ``state`` on and returns it."""
        others = self.code.ffi.NULL if tau_ext is None else self.code.array(tau_ext)
        self.code.call(
            f"{self.plant}_advance", self.prepared, integration, seconds, self.code.array(tau), others, state
        )
        return state

    def control(
        self, gains: Gains, z: ArrayLike, wanted: Sequence[ArrayLike | None], q: ArrayLike, qd: ArrayLike
    ) -> tuple[Vector, Vector]:
        """Torques and integrals after one sample; ``wanted`` is q_ref, qd_ref, tau_ref."""
        memory, tau = self.code.new("controller_state *"), self.code.array(np.zeros(self.n))
        memory.z = list(map(float, np.asarray(z)))
        given = [self.code.ffi.NULL if one is None else self.code.array(one) for one in wanted]
        controller = self._controller(gains)
        self.code.call(
            "control", self.prepared, controller, *given, self.code.array(q), self.code.array(qd), memory, tau
        )
        return np.array(list(tau)), np.array(list(memory.z))

    def simulate(
        self, gains: Gains, integration: Any, reference: Mapping[str, ArrayLike], state: Any, log: bool = True
    ) -> Run:
        """The closed loop over all rows of ``reference`` (q, and qd, tau, tau_ext if given)."""
        rows = len(np.asarray(reference["q"]))
        wanted = self.code.new("reference *")
        arrays = {name: np.ascontiguousarray(value, self.real) for name, value in reference.items()}
        wanted.samples = rows
        for name, value in arrays.items():
            setattr(wanted, name, self.code.pointer(value))
        logs = {"q": self.size, "qd": self.size, "tau": self.n}
        written = {name: np.full((rows + 1, size), np.nan, self.real) for name, size in logs.items()}
        target = self.code.new("run_log *")
        for name, value in written.items() if log else ():
            setattr(target, name, self.code.pointer(value))
        memory = self.code.new("controller_state *")
        controller = self._controller(gains)
        start = time.process_time()
        done = self.code.call(
            f"{self.plant}_simulate", self.prepared, controller, integration, wanted, memory, state, target
        )
        elapsed = time.process_time() - start
        assert all(np.isnan(value[-1]).all() for value in written.values()), "a log was written past its end"
        return Run(*(value[:-1].astype(float) for value in written.values()), done, state, elapsed)

    def timed(self, gains: Gains, integration: Any, reference: Mapping[str, ArrayLike], state: Any) -> float:
        """Seconds of a closed loop in C, nothing logged."""
        return self.simulate(gains, integration, reference, state, log=False).seconds

    def smooth_rate(
        self, tau: ArrayLike, width: float, tau_ext: ArrayLike | None = None
    ) -> Callable[[float, Vector], Vector]:
        """d/dt of [q; qd] with torques held, by the library's model with smooth friction."""
        others = np.zeros(self.n) if tau_ext is None else np.asarray(tau_ext)
        flexible = self.plant == "flexible"
        arrays = (
            [self.code.array(tau), self.code.array(others)] if flexible else [self.code.array(np.asarray(tau) + others)]
        )
        prefix = "flexible_" if self.plant == "flexible" else ""
        function = getattr(self.code.library, f"{self.code.name}_{prefix}direct_dynamics_smooth")
        widths, qdd = self.code.array(np.full(self.size, width)), self.code.array(np.zeros(self.size))

        def rate(_: float, x: Vector) -> Vector:
            function(
                self.prepared, self.code.array(x[: self.size]), self.code.array(x[self.size :]), *arrays, widths, qdd
            )
            return np.concatenate([x[self.size :], list(qdd)])

        return rate

    def constant(self, name: str) -> int:
        """A constant of the header's enumerations."""
        return int(getattr(self.code.library, f"{self.macro}_{name}"))

    def _controller(self, gains: Gains) -> Any:
        result = self.code.new("controller *")
        result.period = gains.period
        for name in ("kp", "kv", "ki", "limit"):
            setattr(result, name, np.broadcast_to(np.asarray(getattr(gains, name), float), self.n).tolist())
        return result
