"""Torques that are recorded too large or too small, motor by motor: recorded = (1 + e) true, ``torque_gain`` =
1 / (1 + e).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import BEYOND, SIGNAL, Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import supplied

#: Recorded torques in parts of the true ones: with them ``torque_gain`` stays within what a robot file may say.
_LEAST, _LARGEST = 0.35, 2.9
#: Size of e up to which a free fit, whose parameters take up most of a gain, tells one from what a joint lacks
#: otherwise.
_BELIEVED = 0.6


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a motor; where the robot's file states a gain, of what is left with it."""
    if not scenes:
        return []
    robot = scenes[0].robot
    stated = robot.signals.torque_gain or [1] * len(robot.moving)
    return [
        Hypothesis(
            "torque_gain",
            "error of the torque's gain" + BEYOND * bool(stated[k] != 1),
            joint.number,
            (_coefficient(f"torque_gain_error{joint.number}", float(stated[k]), scenes),),
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
    ]


def _coefficient(name: str, stated: float, scenes: Sequence[Scene]) -> Coefficient:
    """Beside a ``stated`` gain."""
    least, largest = min(stated * _LEAST - 1, 0.0), max(stated * _LARGEST - 1, 0.0)
    if not any(scene.settled or scene.found(name) for scene in scenes):
        # Beside known values a model that was fitted to the recorded torque is 1 + e times the true one.
        least /= 1 + least
    return Coefficient(name, "1", least, largest, believed=_BELIEVED)


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    return supplied(scene.robot, k, scene.torque)[None]


def _of_model(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    return supplied(scene.robot, k, scene.model_torque)[None]
