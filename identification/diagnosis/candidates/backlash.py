"""Play of a drive train: the link hangs half the gap behind the motor, on the side that its load pushes it to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from generator.robot.description import PRISMATIC, Robot
from identification.diagnosis.hypothesis import ELASTIC, Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.link_side import LinkSide, rotor_inertia
from identification.diagnosis.scene import Scene

Array = NDArray[np.float64]

#: Loads within which the link crosses the gap, in parts of the load's rms.
_QUICKEST, _SLOWEST = 0.02, 0.5


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a joint without a gap in the robot's file and without an encoder on its link; the coefficient is ``gap``.

    The link crosses the gap as tanh(load / width) does: by the gap's middle at no load, smoothly, as the drive train's
    elasticity has it.
    """
    if not scenes:
        return []
    robot = scenes[0].robot
    found = []
    for k, joint in enumerate(robot.moving):
        rotor = rotor_inertia(scenes[0], k)
        watched = any(f"qs{joint.number}" in scene.sampled.run.others for scene in scenes)
        if watched or rotor is None or _has_gap(robot, joint.number):
            continue
        inertia = rotor.grid()[0] if isinstance(rotor, ShapeRange) else rotor
        load = float(np.sqrt(np.mean([np.mean(LinkSide(scene, k, inertia).load ** 2) for scene in scenes])))
        if not load:
            continue
        prismatic = joint.sigma == PRISMATIC
        width = ShapeRange("width", "N" if prismatic else "N m", _QUICKEST * load, _SLOWEST * load)
        searched = isinstance(rotor, ShapeRange)
        found.append(
            Hypothesis(
                "backlash",
                "backlash",
                joint.number,
                (Coefficient(f"gap{joint.number}", "m" if prismatic else "rad", 0.0),),
                partial(_columns, k),
                shapes=(width, rotor) if isinstance(rotor, ShapeRange) else (width,),
                given={} if searched else {"Iam": float(rotor)},  # type: ignore[arg-type]
                kind=ELASTIC,
                joints=(joint.number,),
                variable="load",
                would_show="a load that changes its sign while the joint moves, or an encoder on the link",
                separating={
                    "joint_elasticity": "the same motion with a load that never changes its sign: backlash vanishes",
                    "dahl_friction": "reversals under a load that keeps its sign: presliding shows at each, backlash "
                    "at none",
                    "hysteresis": "reversals under a load that keeps its sign: hysteresis shows at each, backlash at "
                    "none",
                },
            )
        )
    return found


def _has_gap(robot: Robot, number: int) -> bool:
    uses = [use for use in robot.effects if use.effect == "joint_elasticity" and number in use.joints]
    return any("gap" in use.values for use in uses)


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    side = LinkSide(scene, k, shape["Iam"])
    return side.torque_per(-0.5 * np.tanh(side.load / shape["width"]))[None]
