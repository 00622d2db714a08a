"""Torques that are recorded too large or too small, motor by motor: recorded = (1 + e) true, ``torque_gain`` =
1 / (1 + e).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import SIGNAL, Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import supplied

#: Relative errors e of a torque: with them ``torque_gain`` stays within what a robot file may say; and the size up to
#: which a free fit, whose parameters take up most of a gain, tells one from what a joint lacks otherwise.
_LEAST, _LARGEST, _BELIEVED = -0.65, 1.9, 0.6
#: What e looks like beside known values and a model whose torque was fitted to the recorded one: 1 + e times the true
#: one.
_FITTED = _LEAST / (1 + _LEAST)


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a motor, without those whose gain the robot's file states."""
    if not scenes:
        return []
    robot = scenes[0].robot
    stated = robot.signals.torque_gain
    return [
        Hypothesis(
            "torque_gain",
            "error of the torque's gain",
            joint.number,
            (_coefficient(f"torque_gain_error{joint.number}", scenes),),
            partial(_columns, k),
            kind=SIGNAL,
            joints=(joint.number,),
            variable="load",
            would_show="a known payload, or known inertial parameters (--prior): a free fit scales all parameters of "
            "the joint",
            separating={
                "payload": "a run with a known payload",
                "rotor_inertia": "a run with a known payload, or at rest: a gain scales the weight's torque too",
                "gear_ratio": "a known angle at the joint: a wrong gain does not turn it",
                "torque_drift": "one long run: a gain does not change with time",
            },
            of_model=partial(_of_model, k),
        )
        for k, joint in enumerate(robot.moving)
        if not (stated and stated[k] != 1)
    ]


def _coefficient(name: str, scenes: Sequence[Scene]) -> Coefficient:
    least = _LEAST if any(scene.settled or scene.found(name) for scene in scenes) else _FITTED
    return Coefficient(name, "1", least, _LARGEST, believed=_BELIEVED)


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    return supplied(scene.robot, k, scene.torque)[None]


def _of_model(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    return supplied(scene.robot, k, scene.model_torque)[None]
