"""Torques that are recorded too large or too small, motor by motor: recorded = (1 + e) true, ``torque_gain`` =
1 / (1 + e).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from generator.robot.description import Joint
from identification.arrays import Array
from identification.diagnosis.candidates.torque_drift import drift_name
from identification.diagnosis.columns.hypothesis import BEYOND, PRIOR, SIGNAL, Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import supplied

#: Recorded torques in parts of the true ones: with them ``torque_gain`` stays within what a robot file may say.
_LEAST, _LARGEST = 0.35, 2.9
#: Size of e up to which a free fit, whose parameters take up most of a gain, tells one from what a joint lacks
#: otherwise.
_BELIEVED = 0.6


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a motor, and of several one of all alike, as by another unit or a payload that is not the stated one; where
    the robot's file states a gain, of what is left with it. None of a motor of which an earlier search has found a
    drift: that tells with what gain it starts.
    """
    if not scenes:
        return []
    # What was found, and whether it is settled, all scenes share.
    scene = scenes[0]
    moving = scene.robot.moving
    own = [_hypothesis(scene, (joint,), k) for k, joint in enumerate(moving) if not scene.found(drift_name(joint))]
    return [*([_hypothesis(scene, moving, None)] if len(moving) > 1 else []), *own]


def _hypothesis(scene: Scene, joints: Sequence[Joint], k: int | None) -> Hypothesis:
    """Of motor k, or of all."""
    stated = [float(one) for one in scene.robot.signals.torque_gain] or [1.0] * len(scene.robot.moving)
    mine = stated if k is None else [stated[k]]
    joint = None if k is None else joints[0]
    return Hypothesis(
        "torque_gain",
        "error of " + ("all torques' gains" if k is None else "the torque's gain") + BEYOND * any(x != 1 for x in mine),
        0 if joint is None else joint.number,
        (_coefficient(_name(joint), mine, scene),),
        partial(_columns, k),
        kind=SIGNAL,
        joints=tuple(one.number for one in joints),
        variable="load",
        would_show=f"a known payload, or {PRIOR}: where they are free, a fit scales all parameters of the joint",
        separating={
            "payload": "a run with a known payload",
            "stated_payload": "a payload that was weighed",
            "rotor_inertia": "a run with a known payload, or at rest: a gain scales the weight's torque too",
            "gear_ratio": "a known angle at the joint: a wrong gain does not turn it",
            "torque_drift": "one long run: a gain does not change with time",
        },
        of_model=partial(_of_model, k),
    )


def _name(joint: Joint | None) -> str:
    return "torque_gain_error" if joint is None else f"torque_gain_error{joint.number}"


def _coefficient(name: str, stated: Sequence[float], scene: Scene) -> Coefficient:
    """Beside ``stated`` gains."""
    least, largest = min(max(stated) * _LEAST - 1, 0.0), max(min(stated) * _LARGEST - 1, 0.0)
    if not (scene.settled or scene.found(name)):
        # Beside known values a model that was fitted to the recorded torque is 1 + e times the true one.
        least /= 1 + least
    return Coefficient(name, "1", least, largest, believed=_BELIEVED)


def _columns(k: int | None, scene: Scene, shape: Mapping[str, float]) -> Array:
    return _supplied(k, scene, scene.torque)


def _of_model(k: int | None, scene: Scene, shape: Mapping[str, float]) -> Array:
    return _supplied(k, scene, scene.model_torque)


def _supplied(k: int | None, scene: Scene, torque: Array) -> Array:
    """Of a motor beside an error of all: one multiplies what the other left."""
    if k is None:
        return torque[None]
    return (1 + scene.found(_name(None))) * supplied(scene.robot, k, torque)[None]
