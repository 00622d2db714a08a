"""The robot on the link side of one joint's drive train, where the log has the motor's motion.

With q_l = q + e the link's position and q the motor's over the gear, what the motor must supply changes by
(dtau_link/dq) e + (dtau_link/dqd) e' + (dtau_link/dqdd) e'' (report eq. 7, 8). The drive train's own inertia and
friction turn with the motor and do not see e.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any, TypeAlias

import casadi
import numpy as np
from numpy.typing import NDArray

from generator.robot.description import Robot
from generator.symbolic.model import Model
from identification.diagnosis.perturbation import alone, quicker, sensitivity
from identification.diagnosis.scene import Scene
from identification.observation import Motion

Array = NDArray[np.float64]
#: A number, or an array of as many as are played at once.
Value: TypeAlias = Any

#: Part of a base parameter that is the rotor's inertia where nothing tells how much of it is.
_SHARE = 0.5


@dataclass(frozen=True)
class Train:
    """An elastic drive train: ``stiffness`` k [N m/rad, N/m], ``gap`` its play [rad, m], and ``damping`` the ratio
    d / (2 sqrt(k M)) of the link on it, the motor held. Arrays are many of them.
    """

    stiffness: Value
    damping: Value
    gap: Value = 0.0


@dataclass(frozen=True)
class LinkSide:
    """Past the drive train of coordinate ``k``, whose inertia on the joint side is ``rotor`` [kg m2, kg]."""

    scene: Scene
    k: int
    rotor: float

    @cached_property
    def values(self) -> dict[str, float]:
        """Base parameters without what turns with the motor."""
        return without_drive_train(self.scene, self.k, self.rotor)

    def torque_on(self, motion: Motion) -> Array:
        """Torques (n x N) of all but the joint's drive train."""
        return self.scene.torque_of(self.values, motion)

    @cached_property
    def load(self) -> Array:
        """What the drive train transmits (N) [N m, N]."""
        result: Array = self.torque_on(self.scene.motion)[self.k]
        return result

    @cached_property
    def inertia(self) -> Array:
        """Of the links about the joint (N) [kg m2, kg]."""
        result: Array = self.torque_on(quicker(self.scene.motion, self.k))[self.k] - self.load
        return result

    def steps(self, train: Train, end: int) -> Iterator[Value]:
        """Acceleration of the joint's link against the motor, sample by sample up to ``end``."""
        own = self._own(train)
        e, v = self._start(train)
        for load, M in zip(self.load[:end].tolist(), self.inertia[:end].tolist(), strict=True):
            e, v, (_, _, acceleration) = _step(e, v, load, M, own)
            yield acceleration

    def deflection(self, train: Train) -> Motion:
        """The link's motion against the motor's on a drive train of plain numbers."""
        given = np.tile(np.array(self._own(train))[:, None], self.scene.motion.samples)
        steps = _many_steps(self.scene.motion.samples)
        _, played = steps(list(self._start(train)), self.load[None], self.inertia[None], given)
        return alone(self.scene.motion, self.k, np.asarray(played))

    def _own(self, train: Train) -> tuple[Value, Value, Value, Value]:
        """Stiffness, damping d, half of the gap and the samples' period, as ``_step`` takes them."""
        d = 2 * train.damping * np.sqrt(train.stiffness * float(np.mean(self.inertia)))
        return train.stiffness, d, train.gap / 2, self.scene.period

    def _start(self, train: Train) -> tuple[Value, Value]:
        """The log does not tell how the link swings when it begins: it hangs still on its spring."""
        k, half = train.stiffness, train.gap / 2
        e = -(half * np.sign(self.load[0]) + self.load[0] / k)
        return e, (self.load[0] - self.load[1]) / (self.scene.period * k)

    def torque_per(self, deflection: Motion) -> Array:
        """Change of the motors' torques (n x N) per unit of a change of the link's motion against the motor's."""
        return sensitivity(self.torque_on, self.scene.motion, deflection)


class LinkSides:
    """Those of coordinate ``k`` along several scenes, whose loads and inertias are found once."""

    def __init__(self, k: int) -> None:
        self._k = k
        self._made: dict[tuple[int, float], LinkSide] = {}

    def along(self, scene: Scene, rotor: float) -> LinkSide:
        """That of a scene, past a drive train of inertia ``rotor`` [kg m2, kg]."""
        # A scene that is kept by its link side keeps its identity.
        return self._made.setdefault((id(scene), rotor), LinkSide(scene, self._k, rotor))


def _step(e: Value, v: Value, load: Value, M: Value, own: Sequence[Value]) -> tuple[Value, Value, tuple[Value, ...]]:
    """Deflection e and its speed v a sample later; and position, speed and acceleration now:
    M e'' + d e' + k z = -load, z what e is beyond the gap, d nothing within it.

    To the first order in 1/k and without a gap e is -load/k, but that holds far below the resonance alone. Speeds v are
    those between samples, damping is centred: the frequency of a swing is right to the second order.
    """
    k, d, half, h = own
    beyond = e - (abs(e + half) - abs(e - half)) / 2
    c = (abs(e) > half) * d * (h / (2 * M))
    after = (v * (1 - c) - (load + k * beyond) * (h / M)) / (1 + c)
    return e + h * after, after, (e, (v + after) / 2, (after - v) / h)


@cache
def _many_steps(count: int) -> casadi.Function:
    """``count`` steps one after the other: of the first (e, v), loads, inertias and what a train has of its own."""
    state, load, M, own = (casadi.SX.sym(name, size) for name, size in (("x", 2), ("load", 1), ("M", 1), ("own", 4)))
    e, v, seen = _step(state[0], state[1], load, M, casadi.vertsplit(own))
    step = casadi.Function("step", [state, load, M, own], [casadi.vertcat(e, v), casadi.vertcat(*seen)])
    return step.mapaccum("steps", count)


def without_drive_train(scene: Scene, k: int, rotor: float) -> dict[str, float]:
    """The scene's values with those of the joint's own drive-train effects taken out, ``rotor`` from where it is
    grouped.
    """
    model = scene.regressors.model
    own = _of_motor(model, model.robot.moving[k].number)
    inertia = f"Ia{model.robot.moving[k].number}"
    result = dict(scene.values)
    for name, terms in model.grouping.numeric().items():
        if set(terms) <= own:
            result[name] = 0.0
        elif inertia in own & set(terms):
            result[name] = result.get(name, 0.0) - terms[inertia] * rotor
    return result


def rotor_is_told(scene: Scene, k: int) -> bool:
    """Whether the fit or a parameter set of the robot's file has the inertia of the joint's drive train."""
    return _told_rotor(scene, k) is not None


def rotor_inertia(scene: Scene, k: int) -> float:
    """Inertia of the joint's drive train [kg m2, kg]: as the fit or a parameter set of the robot's file has it, else
    half of the base parameter that it is grouped in, 0 where the model has none.
    """
    if (known := _told_rotor(scene, k)) is not None:
        return known
    model = scene.regressors.model
    name = f"Ia{model.robot.moving[k].number}"
    for title, terms in model.grouping.numeric().items():
        if name in terms:
            return max(_SHARE * scene.values.get(title, 0.0) / terms[name], 0.0)
    return 0.0


def _told_rotor(scene: Scene, k: int) -> float | None:
    robot = scene.robot
    number = robot.moving[k].number
    fitted = scene.values.get(f"Ia{number}")
    return told(robot, f"Ia{number}", f"Iam{number}") if fitted is None else fitted


def told(robot: Robot, *names: str) -> float | None:
    """What the first parameter set of the robot's file says that has one of the ``names``; None where none has."""
    values = (one.values[name].value for one in robot.parameter_sets.values() for name in names if name in one.values)
    return next(values, None)


def _of_motor(model: Model, number: int) -> frozenset[str]:
    """Parameters whose torque turns with the motor of a joint, or with another joint's that turns with it."""
    names: set[str] = set()
    for instance in model.effects:
        columns = instance.columns()
        if not instance.effect.on_link and any(number in column for column in columns):
            names |= set(instance.names)
    return frozenset(names)
