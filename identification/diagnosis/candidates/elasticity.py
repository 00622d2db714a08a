"""Drive trains that give way under their load: q_link = q_motor - tau_link / k, and swing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from generator.robot.description import PRISMATIC, Joint
from identification.diagnosis.hypothesis import ELASTIC, Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.link_side import LinkSide, rotor_inertia
from identification.diagnosis.scene import Scene

Array = NDArray[np.float64]

#: Frequencies [Hz] of the link on the stiffnesses that are looked at, the motor held: their range, as a part of the
#: samples' rate no more than the integration can follow, and how many. A lightly damped swing is a tenth wide.
_LOWEST, _HIGHEST, _PART, _STEPS = 3.0, 100.0, 0.125, 60
#: Damping ratios that are tried.
_DAMPING = (0.015, 0.05)
#: Stiffnesses that are tried on all joints.
_TRIED = 3


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a joint whose drive train is stiff in the robot's file and whose link has no encoder of its own.

    The coefficient is the compliance 1/k by the torque's size, the shape ``k`` the stiffness by the frequency of the
    swing; they agree where ``Iam``, the drive train's inertia, is known.
    """
    if not scenes:
        return []
    found = []
    for k, joint in enumerate(scenes[0].robot.moving):
        watched = any(f"qs{joint.number}" in scene.sampled.run.others for scene in scenes)
        if joint.number in scenes[0].robot.flexible or watched:
            continue
        sides = [LinkSide(scene, k, rotor_inertia(scene, k)) for scene in scenes]
        if all(np.min(side.inertia) > 0 for side in sides):
            found.append(_hypothesis(k, joint, sides))
    return found


def _hypothesis(k: int, joint: Joint, sides: Sequence[LinkSide]) -> Hypothesis:
    prismatic = joint.sigma == PRISMATIC
    looked_at = _stiffnesses(sides)
    stiffness = ShapeRange(
        "k", "N/m" if prismatic else "N m/rad", looked_at[0], looked_at[-1], points=_likely(sides, looked_at)
    )
    return Hypothesis(
        "joint_elasticity",
        "elasticity of the drive train",
        joint.number,
        (Coefficient(f"compliance{joint.number}", "m/N" if prismatic else "rad/(N m)", 0.0),),
        partial(_columns, k),
        shapes=(stiffness, ShapeRange("damping", "1", _DAMPING[0] / 5, _DAMPING[-1] * 5, points=_DAMPING)),
        given={"Iam": sides[0].rotor},
        kind=ELASTIC,
        joints=(joint.number,),
        variable="frequency",
        would_show="motion up to a third of the joint's resonance, or an encoder on the link",
        separating={
            "torque_delay": "speed steps at constant load: a delay shows at every step alike, elasticity by the "
            "load's inertia",
            "backlash": "the same motion with a load that never changes its sign: backlash vanishes",
            "rotor_inertia": "a sweep of the frequency: inertia's torque grows with the square, elasticity's with the "
            "fourth power",
        },
        tries=len(looked_at) * len(_DAMPING),
    )


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    side = LinkSide(scene, k, shape["Iam"])
    return shape["k"] * side.torque_per(side.deflection(shape["k"], shape["damping"]))[None]


def _stiffnesses(sides: Sequence[LinkSide]) -> list[float]:
    """All that are looked at, in geometric steps."""
    highest = min(_HIGHEST, *(_PART / side.scene.period for side in sides))
    inertia = float(np.mean([np.mean(side.inertia) for side in sides]))
    return [float(inertia * (2 * np.pi * f) ** 2) for f in np.geomspace(_LOWEST, highest, _STEPS)]


def _likely(sides: Sequence[LinkSide], stiffnesses: Sequence[float]) -> tuple[float, ...]:
    """Those whose swing is most like what the model leaves of the joint's torque, and the stiffest.

    A swing is looked for by its largest part, the inertia of the joint's own link.
    """
    alike = np.array([_likeness(sides, stiffness) for stiffness in stiffnesses])
    inner = np.flatnonzero((alike[1:-1] >= alike[:-2]) & (alike[1:-1] > alike[2:])) + 1
    best = sorted(inner, key=lambda i: alike[i])[-_TRIED:]
    return tuple(sorted({stiffnesses[i] for i in best} | {stiffnesses[-1]}))


def _likeness(sides: Sequence[LinkSide], stiffness: float) -> float:
    """Cosine between the residual and the torque of a swing."""
    products = np.zeros(3)
    for side in sides:
        swing = side.inertia * side.deflection(stiffness, _DAMPING[-1]).qdd[side.k]
        left = (side.scene.tau - side.scene.torque)[side.k]
        products += [swing @ left, swing @ swing, left @ left]
    return float(products[0] / np.sqrt(products[1] * products[2])) if products[1:].all() else 0.0
