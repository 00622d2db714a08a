"""Drive trains that give way under their load: q_link = q_motor - tau_link / k."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from generator.robot.description import PRISMATIC
from identification.diagnosis.hypothesis import ELASTIC, Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.link_side import LinkSide, rotor_inertia
from identification.diagnosis.scene import Scene

Array = NDArray[np.float64]


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a joint whose drive train is stiff in the robot's file and whose link has no encoder of its own.

    The coefficient is the compliance 1/k, of which the torque holds the first order. Where the inertia of the drive
    train is grouped with that of the links, it is a shape: ``Iam`` of the flexible model.
    """
    if not scenes:
        return []
    robot = scenes[0].robot
    found = []
    for k, joint in enumerate(robot.moving):
        rotor = rotor_inertia(scenes[0], k)
        watched = any(f"qs{joint.number}" in scene.sampled.run.others for scene in scenes)
        if joint.number in robot.flexible or watched or rotor is None:
            continue
        searched = isinstance(rotor, ShapeRange)
        found.append(
            Hypothesis(
                "joint_elasticity",
                "elasticity of the drive train",
                joint.number,
                (Coefficient(f"compliance{joint.number}", "m/N" if joint.sigma == PRISMATIC else "rad/(N m)", 0.0),),
                partial(_columns, k),
                shapes=(rotor,) if isinstance(rotor, ShapeRange) else (),
                given={} if searched else {"Iam": float(rotor)},  # type: ignore[arg-type]
                kind=ELASTIC,
                joints=(joint.number,),
                variable="frequency",
                would_show="motion up to a third of the joint's resonance, or an encoder on the link",
                separating={
                    "torque_delay": "speed steps at constant load: a delay shows at every step alike, elasticity by "
                    "the load's inertia",
                    "backlash": "the same motion with a load that never changes its sign: backlash vanishes",
                    "rotor_inertia": "a sweep of the frequency: inertia's torque grows with the square, elasticity's "
                    "with the fourth power",
                },
            )
        )
    return found


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    side = LinkSide(scene, k, shape["Iam"])
    return side.torque_per(-side.load)[None]
