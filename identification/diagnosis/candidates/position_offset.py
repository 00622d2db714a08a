"""Encoders whose zero is not the model's: the robot stands at q + offset, the log says q."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from generator.robot.description import PRISMATIC, Joint
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import BEYOND, PRIOR, SIGNAL, Coefficient, Hypothesis
from identification.diagnosis.runs.perturbation import change_of, sensitivity
from identification.diagnosis.runs.scene import Scene

#: Largest offset [rad, m] that nobody would have seen.
_LARGEST = {False: 0.3, True: 0.1}


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a joint; the coefficient adds to ``position_offset`` of the file's signals."""
    if not scenes:
        return []
    robot = scenes[0].robot
    stated = robot.signals.position_offset or [0] * len(robot.moving)
    return [_hypothesis(k, joint, stated[k] != 0) for k, joint in enumerate(robot.moving)]


def _hypothesis(k: int, joint: Joint, stated: bool) -> Hypothesis:
    largest = _LARGEST[joint.sigma == PRISMATIC]
    return Hypothesis(
        "position_offset",
        "offset of the encoder" + BEYOND * stated,
        joint.number,
        (Coefficient(f"position_offset{joint.number}", joint.position_unit, -largest, largest),),
        partial(_columns, k),
        kind=SIGNAL,
        joints=(joint.number,),
        variable="q",
        would_show=f"{PRIOR}: where they are free, the first moments take an offset up",
        separating={
            "base_tilt": "a level on the base; a tilt shows on all joints whose load is weight, an offset on one",
            "payload": "a run with another, known payload: an offset does not change with it",
            "cable_spring": "a larger range of the joint: the torque of a spring goes on growing",
            "spring_balancer": "a larger range of the joint",
        },
    )


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    change = change_of(scene, k, np.ones_like(scene.t))
    about = scene.found(f"position_offset{scene.robot.moving[k].number}")
    return sensitivity(scene.torque_on, scene.motion, change, about)[None]
