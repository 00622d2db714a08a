"""A gear whose true ratio is 1 + e times that of the robot's file.

Positions from the motor's encoder are then recorded 1 + e times too large, about the encoder's zero, and torques from
the motor's current 1 + e times too small: tau_recorded = tau(q / (1 + e)) / (1 + e), the torque on the joint of the
gear alone. With coupled motors it is the gear on the joint's own side: column j of N is 1 + e times the file's, motor
speeds = N joint speeds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import DRIVE, PRIOR, Coefficient, Hypothesis
from identification.diagnosis.runs.perturbation import scaled, sensitivity
from identification.diagnosis.runs.scene import Scene
from identification.observation import Motion

#: Largest relative error: beyond it the robot would miss its targets visibly.
_LARGEST = 0.2


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a joint of a robot whose file has drives, where all runs hold what the motors did: another ratio in the file
    changes nothing of what was recorded on the joint side.
    """
    if not scenes or scenes[0].robot.drives is None or not all(scene.sampled.run.by_motors for scene in scenes):
        return []
    return [
        Hypothesis(
            "gear_ratio",
            "wrong gear ratio",
            joint.number,
            (Coefficient(f"gear_ratio_error{joint.number}", "1", -_LARGEST, _LARGEST),),
            partial(_columns, k),
            kind=DRIVE,
            joints=(joint.number,),
            variable="load",
            would_show=f"{PRIOR} and motion over the joint's whole range",
            separating={
                "torque_gain": "a known angle at the joint: a wrong ratio turns it too far, a wrong gain does not",
                "position_offset": "positions on both sides of the encoder's zero, and a measured angle between two",
            },
        )
        for k, joint in enumerate(scenes[0].robot.moving)
    ]


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    e = scene.found(f"gear_ratio_error{scene.robot.moving[k].number}")
    # Positions change by 1 / (1 + e) - 1 = -e / (1 + e).
    share = 1 / (1 + e)
    result = share * sensitivity(scene.torque_on, scene.motion, _less(scene, k), share * e)
    result[k] = share * (result[k] - scene.torque[k])
    return result[None]


def _less(scene: Scene, k: int) -> Motion:
    """The change that takes away what the encoder of coordinate ``k`` told, without the file's offset."""
    change, offset = scaled(scene, k, -1.0), scene.robot.signals.position_offset
    if offset:
        change.q[k] += float(offset[k])
    return change
