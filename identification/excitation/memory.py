"""What torques remember of a motion: states inside effects, and how warm the drives have become."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from generator.errors import InputError
from generator.symbolic.effect_torques import reads
from identification import corrections
from identification.arrays import Array
from identification.drive_train import coupling, motor_torques
from identification.observation import Motion, Regressors

#: Times that the heat of torques, which depend on the warmth, is found anew at most; change of it that ends this.
_ROUNDS, _SAME = 20, 1e-6


@dataclass(frozen=True)
class Memory:
    """Of a robot with parameters ``values`` [SI] on a run of so many ``periods`` of a ``frequency`` [Hz].

    The run begins cold, at rest, with zero states.
    """

    regressors: Regressors
    values: Mapping[str, float]
    frequency: float
    periods: int

    @property
    def lasting(self) -> int:
        """Periods that are unlike each other: one where torques remember nothing, else those of the run."""
        return self.periods if self._remembers else 1

    def runs(self, motions: Motion, count: int) -> Motion:
        """Of ``count`` motions of a period, one after the other, at the middles of as many equal parts of it each
        (n x count T): the whole runs, one after the other, as far as they are ``lasting`` (n x count T lasting).
        """
        if not self._remembers:
            return motions
        samples = motions.samples // count
        spacing = 1 / (self.frequency * samples)
        found = []
        for k in range(count):
            one = motions.part(k * samples, (k + 1) * samples)
            whole = Motion(*(np.tile(signal, self.lasting) for signal in one.signals))
            found.append(self.completed(whole, spacing, spacing / 2))
        return _joined(found)

    def completed(self, motion: Motion, spacing: float, start: float = 0.0) -> Motion:
        """A motion of samples ``spacing`` [s] apart, the first ``start`` [s] after the run began, with what torques
        remember of it.

        Raises InputError where nothing says how warm a drive gets on which torques depend.
        """
        whole = self.regressors.completed(motion, spacing)
        if not self._warms:
            return whole
        times = np.arange(motion.samples, dtype=float) * spacing + start
        warmth: Array = np.zeros_like(motion.q)
        for _ in range(_ROUNDS):
            before = warmth
            warmth = self._warmth(replace(whole, warmth=before), times, spacing)
            if np.nanmax(np.abs(warmth - before)) < _SAME:
                break
        return replace(whole, warmth=warmth)

    @property
    def _warms(self) -> bool:
        return reads(self.regressors.model.effects, "warmth")

    @property
    def _remembers(self) -> bool:
        return self._warms or bool(self.regressors.model.effect_states)

    def _warmth(self, motion: Motion, times: Array, spacing: float) -> Array:
        """By the recorded torques of a motion whose drives are as warm as it says (n x N)."""
        robot = self.regressors.model.robot
        motors = motor_torques(robot, self.regressors.torques(self.values, motion))
        recorded = corrections.recorded_motor_torques(motors, robot, spacing, motion.warmth)
        try:
            found = corrections.warmth({}, times, coupling(robot).T @ recorded, robot, robot.place)
        except corrections.Untold as error:
            problem = (
                f"nothing says how warm the drive of joint {error.joint} gets in a motion, on which torques depend"
            )
            raise InputError(robot.place, problem, "warm_up_time in section signals of the robot file") from None
        assert found is not None
        return found


def _joined(motions: list[Motion]) -> Motion:
    """One after the other."""
    q, qd, qdd = (np.concatenate(signals, axis=-1) for signals in zip(*(one.signals for one in motions), strict=True))
    states, warmth = (
        None if getattr(motions[0], name) is None else np.concatenate([getattr(one, name) for one in motions], axis=-1)
        for name in ("states", "warmth")
    )
    return Motion(q, qd, qdd, states, warmth)
