"""Torques that are recorded later than positions: tau_recorded(t) = tau(t - s), at first tau(t) - s dtau/dt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.hypothesis import SIGNAL, Coefficient, Hypothesis
from identification.diagnosis.scene import Scene
from identification.drive_train import supplied

Array = NDArray[np.float64]

#: Longest delay [s] either way that a drive's sampling explains.
_LONGEST = 0.1


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One delay of all torques, and one of each motor's own, without those that the robot's file states.

    The coefficient is ``torque_delay`` of the file's signals; it is negative where positions come later than torques.
    """
    if not scenes:
        return []
    moving, stated = scenes[0].robot.moving, scenes[0].robot.signals.torque_delay
    own = [_hypothesis(one.number, (one.number,), k) for k, one in enumerate(moving) if not (stated and stated[k])]
    if any(stated):
        return own
    together = _hypothesis(0, tuple(joint.number for joint in moving), None)
    return [together, *own] if len(moving) > 1 else [together]


def _hypothesis(joint: int, joints: tuple[int, ...], k: int | None) -> Hypothesis:
    return Hypothesis(
        "torque_delay",
        "delay between torque and position" + (" of all joints" if k is None else ""),
        joint,
        (Coefficient(_name(None if k is None else joint), "s", -_LONGEST, _LONGEST),),
        partial(_columns, k),
        kind=SIGNAL,
        joints=joints,
        variable="frequency",
        would_show="quick changes of torque: higher frequencies, steps of the acceleration",
        separating={
            "joint_elasticity": "speed steps at constant load: a delay shows at every step alike, "
            "elasticity by the load's inertia",
            "viscous_friction": "the same motion twice as fast: a delay of inertia's torque grows with the cube of the "
            "speed, viscous friction with the speed",
            "gradual_friction": "slow reversals: a delay shifts the reversal by a time, gradual friction by a speed",
            "dahl_friction": "slow reversals: a delay shifts the reversal by a time, presliding by a way",
        },
    )


def _name(joint: int | None) -> str:
    return "torque_delay" if joint is None else f"torque_delay{joint}"


def _columns(k: int | None, scene: Scene, shape: Mapping[str, float]) -> Array:
    s = scene.found(_name(None if k is None else scene.robot.moving[k].number))
    tau, t = scene.torque if k is None else supplied(scene.robot, k, scene.torque), scene.t
    late = np.stack([np.interp(t - s, t, row) - row for row in tau]) / s if s else -scene.rate(tau)
    return late[None]
