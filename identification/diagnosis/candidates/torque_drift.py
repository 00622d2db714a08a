"""Torque constants that change while a motor gets warm: true torque = (1 + start)(1 + drift w) recorded.

The warmth w is that of the robot's file. Where that says nothing, it is 1 - exp(-t/T) from the recording's beginning,
or a temperature's rise since then where the runs have one. ``drift`` is ``torque_drift`` of the robot's drives; with
``start`` the constant differs already where w is 0.
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
    """By the warmth of the file, else by time and, where every run has the joint's temperature, by that too; none for a
    drift that the file states.
    """
    if not scenes or scenes[0].robot.drives is None:
        return []
    robot = scenes[0].robot
    stated = robot.drives.torque_drift if robot.drives is not None else ()
    told = all(scene.motion.warmth is not None for scene in scenes)
    duration = max(float(scene.sampled.run.elapsed[-1]) for scene in scenes)
    shortest = max(_SHORTEST * duration, _QUICK)
    time = ShapeRange("warm_up_time", "s", shortest, max(_LONGEST * duration, 2 * shortest))
    found = []
    for k, joint in enumerate(robot.moving):
        if stated and stated[k]:
            continue
        if told:
            found.append(_hypothesis(k, joint, "drive's warmth"))
            continue
        found.append(_hypothesis(k, joint, "time since the start", (time,)))
        rises = [rise for scene in scenes if (rise := scene.rise(k)) is not None]
        highest = max((float(rise.max()) for rise in rises), default=0.0)
        if len(rises) == len(scenes) and highest > _RISE:
            whole = ShapeRange("warm_rise", "K", highest, highest, points=(highest,))
            found.append(_hypothesis(k, joint, "drive's temperature", (whole,)))
    return found


def _hypothesis(k: int, joint: Joint, along: str, shapes: tuple[ShapeRange, ...] = ()) -> Hypothesis:
    return Hypothesis(
        "torque_drift",
        f"drift of the torque constant with the {along}",
        joint.number,
        (
            Coefficient(f"torque_drift{joint.number}", "1", -_LARGEST, _LARGEST, essential=True),
            Coefficient(f"start{joint.number}", "1", -_LARGEST, _LARGEST),
        ),
        partial(_columns, k),
        shapes=shapes,
        kind=DRIVE,
        joints=(joint.number,),
        variable="time",
        would_show="one long run after a cold start, with a load that stays the same",
        separating={
            "warm_friction": "one long run with parts at constant speed and at rest: friction does not change the "
            "torque that holds a weight",
            "torque_gain": "one long run: a gain does not change with time",
        },
        of_model=partial(_of_model, k),
    )


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    return _scaled(k, scene, shape, scene.torque)


def _of_model(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    return _scaled(k, scene, shape, scene.model_torque)


def _scaled(k: int, scene: Scene, shape: Mapping[str, float], torque: Array) -> Array:
    own = supplied(scene.robot, k, torque)
    return -np.stack([own * _warmth(k, scene, shape), own])


def _warmth(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    rise = scene.rise(k)
    if "warm_rise" in shape and rise is not None:
        return rise / shape["warm_rise"]
    return scene.warmth(k, shape.get("warm_up_time"))
