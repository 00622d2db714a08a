"""Torque constants that change while a motor gets warm: true torque = (1 + start)(1 + drift w) recorded.

The warmth w is 1 - exp(-t/T) by the clock of the run's file, or a temperature's rise where the run has one. ``drift``
is ``torque_drift`` of the robot's drives; with ``start`` the constant differs already where w is 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from generator.robot.description import Joint
from identification.diagnosis.hypothesis import DRIVE, Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.scene import Scene
from identification.drive_train import supplied

Array = NDArray[np.float64]

_LARGEST = 0.6
#: Time constants that are tried, in durations of the longest run; none that no motor's winding has [s].
_SHORTEST, _LONGEST, _QUICK = 0.2, 5.0, 10.0
#: Rise of a temperature [K] below which nothing has got warm.
_RISE = 2.0


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """By time and, where every run has the joint's temperature, by that; none for a drift that the file states."""
    if not scenes or scenes[0].robot.drives is None:
        return []
    robot = scenes[0].robot
    stated = robot.drives.torque_drift if robot.drives is not None else ()
    duration = max(float(scene.t[-1] - scene.t[0]) for scene in scenes)
    shortest = max(_SHORTEST * duration, _QUICK)
    time = ShapeRange("T", "s", shortest, max(_LONGEST * duration, 2 * shortest))
    found = []
    for k, joint in enumerate(robot.moving):
        if stated and stated[k]:
            continue
        found.append(_hypothesis(joint, partial(_columns, k), (time,), {}))
        column = f"temp{joint.number}"
        if all(column in scene.sampled.run.others for scene in scenes):
            values = np.concatenate([_temperature(scene, column) for scene in scenes])
            cold, rise = float(values.min()), float(np.ptp(values))
            if rise > _RISE:
                found.append(_hypothesis(joint, partial(_columns, k), (), {"cold": cold, "rise": rise}))
    return found


def _hypothesis(
    joint: Joint, columns: partial[Array], shapes: tuple[ShapeRange, ...], given: Mapping[str, float]
) -> Hypothesis:
    return Hypothesis(
        "torque_drift",
        "drift of the torque constant with the " + ("time since the start" if shapes else "drive's temperature"),
        joint.number,
        tuple(Coefficient(f"{name}{joint.number}", "1", -_LARGEST, _LARGEST) for name in ("torque_drift", "start")),
        columns,
        shapes=shapes,
        given=given,
        kind=DRIVE,
        joints=(joint.number,),
        variable="time",
        would_show="one long run after a cold start, with a load that stays the same",
        separating={
            "warm_friction": "one long run with parts at constant speed and at rest: friction does not change the "
            "torque that holds a weight",
            "torque_gain": "one long run: a gain does not change with time",
        },
    )


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    own = supplied(scene.robot, k, scene.torque)
    return -np.stack([own * _warmth(k, scene, shape), own])


def _warmth(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    if "T" in shape:
        return np.asarray(1 - np.exp(-scene.sampled.times / shape["T"]))
    column = f"temp{scene.robot.moving[k].number}"
    return (_temperature(scene, column) - shape["cold"]) / shape["rise"]


def _temperature(scene: Scene, column: str) -> Array:
    """A temperature [K] at the samples of the scene (N)."""
    first = scene.sampled.filters.first
    return scene.sampled.run.others[column][first : first + scene.motion.samples]
