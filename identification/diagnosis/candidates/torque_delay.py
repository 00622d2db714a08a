"""Torques that are recorded later than positions: tau_recorded(t) = tau(t - s), at first tau(t) - s dtau/dt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from generator.robot.description import Joint
from identification.diagnosis.hypothesis import SIGNAL, Coefficient, Hypothesis
from identification.diagnosis.lateness import LONGEST, Lateness, latenesses, told, torques
from identification.diagnosis.scene import Scene
from identification.drive_train import supplied
from identification.outcome import Value

Array = NDArray[np.float64]


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One delay of all torques, and one of each motor's own, without those that the robot's file states.

    The coefficient is ``torque_delay`` of the file's signals; it is negative where positions come later than torques.
    """
    if not scenes:
        return []
    moving, stated = scenes[0].robot.moving, scenes[0].robot.signals.torque_delay
    late = latenesses(scenes)
    own = [_hypothesis((one,), k, late, scenes[0]) for k, one in enumerate(moving) if not (stated and stated[k])]
    if any(stated):
        return own
    together = _hypothesis(moving, None, late, scenes[0])
    return [together, *own] if len(moving) > 1 else [together]


def _hypothesis(joints: Sequence[Joint], k: int | None, late: Sequence[Lateness | None], scene: Scene) -> Hypothesis:
    joint = None if k is None else joints[0]
    beyond = told(late if k is None else [late[k]], _before(joint, scene))
    return Hypothesis(
        "torque_delay",
        "delay between torque and position" + (" of all joints" if k is None else ""),
        0 if joint is None else joint.number,
        (Coefficient(_name(joint), "s", -LONGEST, LONGEST),),
        partial(_columns, k, late, beyond),
        kind=SIGNAL,
        told={} if beyond is None else {_name(joint): beyond},
        joints=tuple(one.number for one in joints),
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


def _name(joint: Joint | None) -> str:
    return "torque_delay" if joint is None else f"torque_delay{joint.number}"


def _columns(
    k: int | None, late: Sequence[Lateness | None], beyond: Value | None, scene: Scene, shape: Mapping[str, float]
) -> Array:
    """Of a delay that is as long as ``late`` rows tell, ``beyond`` that of all joints, the difference that it makes per
    second of it; as long as was found where they tell none.
    """
    joint = None if k is None else scene.robot.moving[k]
    if beyond is None or beyond.value is None:
        tau, start, delay = scene.torque, 0.0, scene.found(_name(joint))
    else:
        start, delay = _before(joint, scene), beyond.value
        tau = scene.torque if scene.found(_name(joint)) else torques(scene, late, start + delay)
    if k is not None:
        tau = supplied(scene.robot, k, tau)
    if not delay:
        return -scene.rate(tau)[None]
    t = scene.t
    return np.stack([np.interp(t - start - delay, t, row) - np.interp(t - start, t, row) for row in tau])[None] / delay


def _before(joint: Joint | None, scene: Scene) -> float:
    """How late a joint's torque is known to be without its own delay [s]."""
    return 0.0 if joint is None else scene.found(_name(None))
