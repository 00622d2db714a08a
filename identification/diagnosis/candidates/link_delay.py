"""Encoders on the links that tell their positions later than the motors' encoders.

No rigid model's torque depends on them: the delay is told by the two encoders of a joint alone, not by what the model
leaves of its torque (``identification.link_encoders``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from generator.robot.description import Joint
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import SIGNAL, Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene
from identification.link_encoders import RECIPE, astray, of_runs
from identification.outcome import Value

#: Longest delay [s] that a robot's file may state.
_LONGEST = 0.1
#: Standard deviations that a delay must be away from none.
_SURE = 5.0


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a joint whose link has an encoder that is late, by as much as ``measured``; none for a delay that the robot's
    file states, nor for an encoder that goes elsewhere than its motor.
    """
    if not scenes:
        return []
    robot = scenes[0].robot
    names = [f"qs{joint.number}" for joint in robot.moving]
    runs = [scene.sampled.run for scene in scenes]
    runs = [
        run for run in runs if run.samples >= RECIPE.at(run.rate).fewest and any(one in run.others for one in names)
    ]
    if not runs:
        return []
    found = of_runs(robot, runs, scenes[0].values).latency
    stated = robot.signals.link_delay
    return [
        _hypothesis(joint, latency)
        for k, joint in enumerate(robot.moving)
        if (latency := found.get(f"latency{joint.number}"))
        and not (stated and stated[k])
        and not any(astray(run, k, joint) for run in runs)
        and _late(latency)
    ]


def _late(latency: Value) -> bool:
    return latency.value is not None and _SURE * latency.std < latency.value <= _LONGEST


def _hypothesis(joint: Joint, latency: Value) -> Hypothesis:
    name = f"link_delay{joint.number}"
    return Hypothesis(
        "link_delay",
        "latency of the link's encoder",
        joint.number,
        (Coefficient(name, "s", 0.0, _LONGEST),),
        _columns,
        kind=SIGNAL,
        joints=(joint.number,),
        variable="qd",
        would_show="faster motion of the joint",
        separating={
            "joint_elasticity": "counterpoise stiffness --link-encoders, on motion at several loads and speeds"
        },
        measured={name: latency},
    )


def _columns(scene: Scene, shape: Mapping[str, float]) -> Array:
    return np.zeros((1, *scene.motion.q.shape))
