"""Drive trains that give way under their load: q_link = q_motor - tau_link / k, and swing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from generator.robot.description import PRISMATIC, Joint
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import ELASTIC, Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.columns.rotor_share import rotor_range
from identification.diagnosis.noise.torque_band import end
from identification.diagnosis.runs.first_swing import FirstSwings
from identification.diagnosis.runs.link_side import LinkSides, Train
from identification.diagnosis.runs.rotor import rotor_is_told
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.runs.stated_elasticity import stated
from identification.diagnosis.runs.swings import DAMPING, USUAL_DAMPING, Alike, alike, liveliest, stiffnesses, watched
from identification.side_by_side import side_by_side

#: Stiffnesses and damping ratios that are looked at.
_STEPS, _DAMPINGS = 60, 3
#: Part of the stiffness of the swing that the torque's size must tell at least, and the other way round: where the
#: rotor's inertia is known, and where it is not.
_ALIKE, _ROUGHLY = 0.3, 0.1
#: Step of the logarithm by which a stiffness is searched between them.
_FINE = 0.05


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a joint whose link has no encoder of its own: with one, ``identification.link_encoders`` tells the stiffness
    without any torque that a model lacks. None where the robot's file states a stiffness (``stated_elasticity``), and
    where recorded torques lack what is quick (``torque_band``), as those of elastic drive trains do.

    The coefficient is the compliance 1/k by the torque's size, the shape ``k`` the stiffness by the frequency of the
    swing; they agree, closely where ``Iam``, the drive train's inertia, is known.
    """
    if not scenes or np.isfinite(end(scenes)):
        return []
    known = [one.k for one in stated(scenes[0].robot)]
    sides = [
        (joint, LinkSides(side))
        for k, joint in enumerate(scenes[0].robot.moving)
        if k not in known and not watched(scenes, k)
        if (side := liveliest(scenes, k)) is not None
    ]
    swinging = side_by_side(lambda one: _swinging(*one, scenes), sides)
    return [_hypothesis(*one, *seen) for one, seen in zip(sides, swinging, strict=True)]


def _swinging(joint: Joint, sides: LinkSides, scenes: Sequence[Scene]) -> tuple[ShapeRange | None, Alike]:
    """The inertia of the drive train where it is sought, and the trains that swing as the log has it."""
    side = sides.first
    rotor = None if rotor_is_told(side.scene, side.k) else rotor_range(sides, scenes, joint.inertia_unit)
    grids = [np.geomspace(*stiffnesses(side), _STEPS), np.geomspace(*USUAL_DAMPING, _DAMPINGS), np.zeros(1)]
    return rotor, alike([side], grids)


def _hypothesis(joint: Joint, sides: LinkSides, rotor: ShapeRange | None, found: Alike) -> Hypothesis:
    side = sides.first
    low, high = stiffnesses(side)
    # The stiffest swings too fast to be seen and shows its deflection alone.
    starts = {one[:3] for one in found} | {(found[0][0], high, found[0][2])}
    told = rotor_is_told(side.scene, side.k)
    return Hypothesis(
        "joint_elasticity",
        "elasticity of the drive train",
        joint.number,
        (Coefficient(f"compliance{joint.number}", "m/N" if joint.sigma == PRISMATIC else "rad/(N m)", 0.0),),
        partial(_columns, sides, FirstSwings()),
        shapes=(
            *([rotor] if rotor else []),
            ShapeRange("k", joint.stiffness_unit, low, high, step=_FINE),
            ShapeRange("damping", "1", *DAMPING, step=5 * _FINE),
        ),
        given={} if rotor else {"Iam": side.rotor},
        units={"Iam": joint.inertia_unit},
        kind=ELASTIC,
        joints=(joint.number,),
        variable="frequency",
        would_show="motion up to a third of the joint's resonance; counterpoise stiffness by an encoder on the link",
        separating={
            "torque_delay": "speed steps at constant load: a delay shows at every step alike, elasticity by the "
            "load's inertia",
            "backlash": "the same motion with a load that never changes its sign: backlash vanishes",
            "rotor_inertia": "a sweep of the frequency: inertia's torque grows with the square, elasticity's with the "
            "fourth power",
        },
        tries=_STEPS * _DAMPINGS,
        agrees=partial(_agrees, _ALIKE if told else _ROUGHLY),
        twice={f"compliance{joint.number}": ("k", -1)},
        starts=tuple(
            {"Iam": inertia, "k": stiffness, "damping": damping} for inertia, stiffness, damping in sorted(starts)
        ),
    )


def _agrees(least: float, coefficients: Array, shape: Mapping[str, float]) -> bool:
    """Whether the size of the torque tells nearly the stiffness that the swing tells."""
    return bool(least < shape["k"] * coefficients[0] < 1 / least)


def _columns(sides: LinkSides, first: FirstSwings, scene: Scene, shape: Mapping[str, float]) -> Array:
    side = sides.along(scene, shape["Iam"])
    return shape["k"] * first.torque(side, Train(shape["k"], shape["damping"]))[None]
