"""A robot with its effects, as numbers for the C core."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.plant.compiled import EFFECTS, JOINTS, VALUES, CPlant, library
from tests.plant.effect import Effect
from tests.plant.library import TORQUES
from tests.plant.robot import BODY, Array, Robot, rotation

FREE_FALL = (0.0, 0.0, -9.81)

#: Order of the ten numbers of a body in C.
_C_ORDER = [BODY.index(name) for name in ("M", "MX", "MY", "MZ", "XX", "XY", "XZ", "YY", "YZ", "ZZ")]


@dataclass
class Machine:
    """What moves: arrays by joint (n), from 0, that effects may change before the run."""

    robot: Robot
    effects: tuple[Effect, ...]

    def __post_init__(self) -> None:
        """The robot as its data say, then the effects' changes."""
        robot, n = self.robot, self.robot.joints
        self.body = np.array([joint.body for joint in robot.chain], dtype=float)
        self.gravity: Array = robot.base_rotation.T @ np.array(FREE_FALL)
        self.rotor = np.diag(robot.column("rotor"))
        self.flexible = np.zeros(n, dtype=bool)
        self.stiffness, self.damping, self.gap = np.zeros((3, n))
        self.gain, self.encoder_scale = np.ones((2, n))
        self.limit = robot.column("peak")
        self.heat_drop, self.heat, self.encoder_offset = np.zeros((3, n))
        self.heat_time, self.heat_current = np.ones((2, n))
        self.torques = tuple(effect for effect in self.effects if effect.what.torque)
        for effect in self.effects:
            if effect.what.change:
                effect.what.change(self, effect)

    def make_elastic(self, joint: int, stiffness: float, damping_ratio: float) -> None:
        """An elastic drive train on a joint; a second one on the same joint is in series with the first."""
        before = 1 / self.stiffness[joint] if self.flexible[joint] else 0.0
        self.flexible[joint] = True
        self.stiffness[joint] = 1 / (before + 1 / stiffness)
        self.damping[joint] = 2 * damping_ratio * np.sqrt(self.stiffness[joint] * self.rotor[joint, joint])

    def add_body(self, mass: float, centre: Array, radius: float) -> None:
        """A round body, whose radius of gyration is ``radius``, with its centre [m] in the last frame."""
        about = mass * (radius**2 * np.eye(3) + centre @ centre * np.eye(3) - np.outer(centre, centre))
        self.body[-1] += [*about[np.triu_indices(3)], *(mass * centre), mass]

    def lean(self, angle: float, towards: float) -> None:
        """Lean the base by ``angle`` about the horizontal line at the angle ``towards`` in the world."""
        about = rotation(0.0, 0.0, towards) @ rotation(angle, 0.0, 0.0) @ rotation(0.0, 0.0, -towards)
        self.gravity = self.robot.base_rotation.T @ about.T @ np.array(FREE_FALL)

    @property
    def ratios(self) -> Array:
        """What positions and torques are converted with (n x n)."""
        return self.robot.ratios

    def inertia_matrix(self, q: Array) -> Array:
        """Of bodies and rotors (n x n), drive trains taken as rigid."""
        return self._state(q)[1] + self.rotor

    def potential_energy(self, q: Array) -> float:
        """Of the weight [J], zero where every body is at the origin."""
        return self._state(q)[0]

    def _state(self, q: Array) -> tuple[float, Array]:
        n = self.robot.joints
        mass = np.zeros((n, n))
        energy = library().plant_state(ctypes.byref(self.in_c()), pointer(q), pointer(mass))
        return float(energy), mass

    def rigid_torques(self, q: Array, qd: Array, qdd: Array) -> Array:
        """Torques (T x n) of bodies and rotors along a motion (T x n each), drive trains taken as rigid."""
        q, qd, qdd = (np.ascontiguousarray(x, dtype=float) for x in (q, qd, qdd))
        tau = np.zeros_like(q)
        library().plant_torques(ctypes.byref(self.in_c()), len(q), pointer(q), pointer(qd), pointer(qdd), pointer(tau))
        return tau

    def law_torques(self, q: Array, qd: Array, step: float, start_time: float = 0.0) -> Array:
        """Torque of each effect (T x effects that are torques) along a motion (T x n each) sampled every ``step``
        seconds.
        """
        plant = self.in_c()
        plant.start_time = start_time
        q, qd = (np.ascontiguousarray(x, dtype=float) for x in (q, qd))
        out = np.zeros((len(q), len(self.torques)))
        library().plant_replay(
            ctypes.byref(plant), ctypes.c_double(step), len(q), pointer(q), pointer(qd), pointer(out)
        )
        return out

    def fastest(self, q: Array) -> float:
        """The highest frequency [rad/s] of the elastic drive trains at q, 0 without any."""
        elastic = np.flatnonzero(self.flexible)
        if not elastic.size:
            return 0.0
        n, m = self.robot.joints, elastic.size
        A, K = np.zeros((2, n + m, n + m))
        A[:n, :n] = self._state(q)[1]
        at = np.arange(n)
        at[elastic] = n + np.arange(m)
        A[np.ix_(at, at)] += self.rotor
        for k, j in enumerate(elastic):
            apart = np.zeros(n + m)
            apart[[int(j), n + k]] = 1.0, -1.0
            K += self.stiffness[j] * np.outer(apart, apart)
        return float(np.sqrt(np.max(np.linalg.eigvals(np.linalg.solve(A, K)).real)))

    def in_c(self) -> CPlant:
        """The structure of c/plant.h, without the controller; raises ValueError where it is too small."""
        robot, n = self.robot, self.robot.joints
        if n > JOINTS or len(self.torques) > EFFECTS:
            raise ValueError(f"{n} joints and {len(self.torques)} torques, at most {JOINTS} and {EFFECTS}")
        plant = CPlant(n=n, effects=len(self.torques))
        one_each: dict[str, Sequence[Any] | Array] = {
            "prismatic": [int(joint.prismatic) for joint in robot.chain],
            "flexible": [int(flag) for flag in self.flexible],
            "constant": robot.column("constant"),
            "encoder_step": np.full(n, 2 * np.pi / 2**robot.encoder_bits),
        }
        for name in ("stiffness", "damping", "gap", "gain", "limit", "encoder_scale", "encoder_offset"):
            one_each[name] = getattr(self, name)
        for name in ("heat_drop", "heat_time", "heat_current", "heat"):
            one_each[name] = getattr(self, name)
        for name, values in one_each.items():
            fill(getattr(plant, name), values)
        fill(plant.gravity, self.gravity)
        inverse = np.linalg.inv(robot.ratios)
        for j, joint in enumerate(robot.chain):
            fill(plant.dh[j], joint.dh)
            fill(plant.body[j], self.body[j][_C_ORDER])
            fill(plant.rotor[j], self.rotor[j])
            fill(plant.ratio[j], robot.ratios[j])
            fill(plant.inverse[j], inverse[j])
        for slot, effect in zip(plant.effect, self.torques, strict=False):
            values = effect.all_values(robot)
            if len(values) > VALUES:
                raise ValueError(f"{effect.law} has {len(values)} values, at most {VALUES}")
            slot.law, slot.joint = TORQUES.index(effect.law), effect.joint - 1
            slot.other, slot.size = (effect.other or effect.joint) - 1, effect.amount(robot)
            fill(slot.weight, effect.along(robot))
            fill(slot.value, values)
        return plant


def fill(array: Any, values: Sequence[Any] | Array) -> None:
    """Write numbers to the head of a C array."""
    for k, value in enumerate(values):
        array[k] = value


def pointer(array: Array) -> Any:
    """To the first number of a contiguous array."""
    assert array.flags.c_contiguous
    assert array.dtype == np.float64
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
