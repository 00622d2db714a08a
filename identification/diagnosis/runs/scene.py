"""One run beside the model as it stands: all that a candidate's columns may be made of."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from generator.effects.effect import accelerates
from generator.robot.description import Robot
from generator.robot.parameters import INERTIAL_STEMS
from identification.arrays import Array
from identification.corrections import heated, warming_up
from identification.drive_train import motor_torques
from identification.filtering import flat_derivative
from identification.observation import Motion, Regressors
from identification.sampling import Sampled
from identification.standstill import stands_throughout


class Beside(Protocol):
    """What acts beside the model: coefficients by name, torques and loads (n x N) [N m, N] along a scene."""

    @property
    def coefficients(self) -> Mapping[str, float]:
        """Their values by name [SI]."""

    def shape(self, effect: str, joint: int) -> Mapping[str, float]:
        """That of an effect on a joint by number, empty where it does not act."""

    def torque(self, scene: Scene) -> Array:
        """Torques of what acts (n x N) [N m, N], on the joint side, along the scene's motion."""

    def load(self, scene: Scene) -> Array:
        """The part of these torques that loads the drives (n x N) [N m, N]."""

    def body(self, scene: Scene) -> Array:
        """Inertial parameters (10) [SI] of what the tool carries of it, in the tool's frame, along the scene."""


@dataclass(frozen=True)
class Scene:
    """A run of N samples at the recorded rate, and the model with ``values`` of its base parameters by name [SI].

    The model carries the payload that the run's sidecar tells; ``beside`` is what an earlier search has found. The
    values are ``settled`` where they are no first fit, which something missing pulls away from what is known.
    """

    sampled: Sampled
    regressors: Regressors
    values: Mapping[str, float]
    beside: Beside | None = None
    settled: bool = True

    @property
    def robot(self) -> Robot:
        """As its file says."""
        return self.regressors.model.robot

    @property
    def motion(self) -> Motion:
        """Filtered positions, speeds, accelerations (n x N each)."""
        return self.sampled.motion

    @property
    def tau(self) -> Array:
        """Measured torques on the joint side (n x N) [N m, N]."""
        return self.sampled.tau

    @property
    def t(self) -> Array:
        """Time since the recording began [s] (N)."""
        return self._inside(self.sampled.run.elapsed)

    def warmth(self, k: int, warm_up_time: float | None = None) -> Array:
        """How warm the drive of coordinate ``k`` is (N), 0 after a cold start: as the robot's file says, or by
        ``warm_up_time`` [s]; not a number where neither tells.
        """
        if warm_up_time is not None:
            return warming_up(self._inside(self.sampled.run.warming), warm_up_time)
        if self.motion.warmth is None:
            return np.full(self.motion.samples, np.nan)
        told: Array = self.motion.warmth[k]
        return told

    def motor_torque(self, k: int) -> Array:
        """Torque that was recorded of the motor of coordinate ``k`` since the run's start [N m] (M)."""
        gain = self.robot.signals.torque_gain
        motor: Array = self._motor_torques[k]
        return motor / float(gain[k]) if gain else motor

    @cached_property
    def _motor_torques(self) -> Array:
        return motor_torques(self.robot, self.sampled.run.tau)

    def heat(self, k: int, warm_torque: float, warm_up_time: float) -> Array:
        """How warm the drive of coordinate ``k`` is (N) by its motor's torque, as ``corrections.heated``."""
        return self._inside(heated(self.motor_torque(k) / warm_torque, self.sampled.run.warming, warm_up_time))

    def warmth_is_stated(self, k: int) -> bool:
        """Whether the robot's file says how warm the drive of coordinate ``k`` is."""
        return bool(np.all(np.isfinite(self.warmth(k))))

    def rise(self, k: int) -> Array | None:
        """Of the drive's temperature since the recording began [K] (N); None where the run has none."""
        values = self.sampled.run.rises.get(f"temp{self.robot.moving[k].number}")
        return None if values is None else self._inside(values)

    def _inside(self, x: Array) -> Array:
        """A signal of the whole run at the scene's samples."""
        first = self.sampled.filters.first
        return x[first : first + self.motion.samples]

    @property
    def period(self) -> float:
        """Of the samples [s]."""
        return self.sampled.run.period

    def moves(self, k: int) -> bool:
        """Whether coordinate ``k`` moves."""
        return not stands_throughout(self.motion.q[k])

    @cached_property
    def torque(self) -> Array:
        """Torques along the motion (n x N) [N m, N], as ``torque_on``."""
        return self.torque_on(self.motion)

    def torque_on(self, motion: Motion) -> Array:
        """Torques along another motion (n x N) [N m, N] of the model and of the effects that were found."""
        tau = self.torque_of(self.values, motion)
        return tau if self.beside is None else tau + self.beside.torque(self._alone(motion))

    def torque_of(self, values: Mapping[str, float], motion: Motion) -> Array:
        """Torques of the model with other ``values`` along another motion (n x N) [N m, N]."""
        return self.regressors.torques(values, motion) + self.carried(motion)

    @property
    def body(self) -> Array:
        """Inertial parameters (10) [SI] of what the tool carries, in its frame: the run's known payload, and what was
        found.
        """
        payload = self.sampled.run.payload
        known = (
            np.zeros(len(INERTIAL_STEMS))
            if payload is None
            else np.array([payload.known[stem] for stem in INERTIAL_STEMS])
        )
        return known if self.beside is None else known + self.beside.body(self)

    def carried(self, motion: Motion) -> Array:
        """Torques of the run's known payload along a motion (n x N) [N m, N] (report eq. 50); zero without one."""
        payload = self.sampled.run.payload
        if payload is None:
            return np.zeros_like(motion.q)
        body = np.array([payload.known[stem] for stem in payload.names()])
        return np.stack([body @ columns for columns in self.regressors.payload(motion)])

    @cached_property
    def model_torque(self) -> Array:
        """Torques along the motion (n x N) [N m, N] of the model alone."""
        return self.torque_of(self.values, self.motion)

    @cached_property
    def weight(self) -> Array:
        """Torques at rest of the bodies alone, and of a known payload (n x N)."""
        return self.torque_of(self._made_of(self._of_bodies), self._at_rest)

    @property
    def _of_bodies(self) -> set[str]:
        return {f"{stem}{body.number}" for body in self.robot.bodies for stem in INERTIAL_STEMS}

    def _made_of(self, names: Collection[str]) -> dict[str, float]:
        """Values of the base parameters in which standard parameters of these names are."""
        grouped = self.regressors.model.grouping.numeric()
        return {name: x for name, x in self.values.items() if any(part in names for part in grouped.get(name, {}))}

    @property
    def _at_rest(self) -> Motion:
        still = np.zeros_like(self.motion.q)
        return replace(self.motion, qd=still, qdd=still, states=None)

    def _alone(self, motion: Motion) -> Scene:
        """The model by itself on another motion: what acts beside it may ask for its load."""
        return Scene(replace(self.sampled, motion=motion), self.regressors, self.values)

    @cached_property
    def load(self) -> Array:
        """Loads of the drives (n x N): all of the model's torque but friction, and of a known payload."""
        loading = {
            name
            for one in self.regressors.model.effects
            for name, column in zip(one.names, one.columns(), strict=True)
            if one.effect.loads or ("load" not in one.effect.needs and accelerates(column))
        }
        load = self.torque_of(self._made_of(self._of_bodies | loading), self.motion)
        return load if self.beside is None else load + self.beside.load(self._alone(self.motion))

    def found(self, name: str) -> float:
        """A coefficient that an earlier search has found, zero where it has not."""
        return 0.0 if self.beside is None else self.beside.coefficients.get(name, 0.0)

    def shape_found(self, effect: str, joint: int) -> Mapping[str, float]:
        """The shape of an effect on a joint by number that an earlier search has found, empty where it has not."""
        return {} if self.beside is None else self.beside.shape(effect, joint)

    def derivative(self, x: Array) -> Array:
        """Time derivative of signals with samples along the last axis, as the motion's speeds are."""
        return flat_derivative(x, self.period)
