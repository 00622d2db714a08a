"""Play of a drive train: the link falls through the gap wherever its load changes sign, and swings where it lands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from generator.robot.description import Joint, Robot
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import ELASTIC, Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.columns.rotor_share import rotor_range
from identification.diagnosis.noise.torque_band import end
from identification.diagnosis.runs.link_side import LinkSide, LinkSides, Train
from identification.diagnosis.runs.rotor import rotor_is_told
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.runs.swings import DAMPING, USUAL_DAMPING, Alike, alike, liveliest, stiffnesses, watched
from identification.residuals import rms
from identification.side_by_side import side_by_side

#: Times [s] in which a link falls through the gap that are looked for.
_QUICKEST, _SLOWEST = 0.01, 0.2
#: Stiffnesses, damping ratios and gaps that are looked at.
_STEPS, _DAMPINGS, _GAPS = 10, 3, 24
#: Parts of an inertia that are a rotor's where nothing tells it, which are tried first.
_PARTS = (0.3, 0.6, 0.9)
#: Step of the logarithm by which a gap is searched between them.
_FINE = 0.1
#: Errors of the load, in parts of its spread, over which the torque is a mean: how a link bounces they change.
ERRORS = (-0.0025, 0.0, 0.0025)
#: Part of the gap of the fall's time that the torque's size must tell at least, and the other way round: a link that
#: falls is missing with all its load.
_ALIKE = 0.1
#: Part of what the drive train gives way under its load, below which a gap is none: elasticity alone does as much.
_OPEN = 0.02


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a joint without a gap in the robot's file and without an encoder on its link; none where recorded
    torques lack what is quick (``torque_band``).

    The coefficient is the gap by the torque's size, the shape ``gap`` that by the times of its crossing.
    ``Iam`` is the drive train's inertia, ``k`` is the stiffness beyond the gap.
    """
    if not scenes or np.isfinite(end(scenes)):
        return []
    sides = [
        (joint, LinkSides(side))
        for k, joint in enumerate(scenes[0].robot.moving)
        if not _has_gap(scenes[0].robot, joint.number) and not watched(scenes, k)
        if (side := liveliest(scenes, k)) is not None and _changes_sign(side)
    ]
    swinging = side_by_side(lambda one: _swinging(*one, scenes), sides)
    return [_hypothesis(*one, *seen) for one, seen in zip(sides, swinging, strict=True)]


def _swinging(joint: Joint, sides: LinkSides, scenes: Sequence[Scene]) -> tuple[ShapeRange | None, Alike]:
    """The inertia of the drive train where it is sought, and the trains that swing as the log has it."""
    side, rotor = sides.first, rotor_range(sides, scenes, joint.inertia_unit)
    found = alike(
        _tried(sides, rotor),
        [
            np.geomspace(*stiffnesses(side), _STEPS),
            np.geomspace(*USUAL_DAMPING, _DAMPINGS),
            np.geomspace(*_gaps(side), _GAPS),
        ],
    )
    return rotor, found


def _tried(sides: LinkSides, rotor: ShapeRange | None) -> list[LinkSide]:
    """Those past drive trains of the inertias that are tried first; as it is where that is known."""
    side = sides.first
    if rotor is None or rotor_is_told(side.scene, side.k):
        return [side]
    return [sides.along(side.scene, part * rotor.high) for part in _PARTS]


def _hypothesis(joint: Joint, sides: LinkSides, rotor: ShapeRange | None, found: Alike) -> Hypothesis:
    side = sides.first
    softest, stiffest = stiffnesses(side)
    narrow, wide = _gaps(side)
    return Hypothesis(
        "backlash",
        "backlash",
        joint.number,
        (Coefficient(f"gap{joint.number}", joint.position_unit, 0.0),),
        partial(_columns, sides),
        shapes=(
            *([rotor] if rotor else []),
            ShapeRange(
                "gap",
                joint.position_unit,
                narrow,
                wide,
                step=_FINE,
                vanishing=True,
                vanishes=partial(_closed, rms(side.load)),
            ),
            ShapeRange("k", joint.stiffness_unit, softest, stiffest, step=2 * _FINE),
            ShapeRange("damping", "1", *DAMPING, step=5 * _FINE),
        ),
        given={} if rotor else {"Iam": side.rotor},
        units={"Iam": joint.inertia_unit},
        kind=ELASTIC,
        joints=(joint.number,),
        variable="load",
        would_show="a load that changes its sign while the joint moves",
        separating={
            "joint_elasticity": "the same motion with a load that never changes its sign: backlash vanishes",
            "dahl_friction": "reversals under a load that keeps its sign: presliding shows at each, backlash at none",
            "hysteresis": "reversals under a load that keeps its sign: hysteresis shows at each, backlash at none",
        },
        tries=_STEPS * _DAMPINGS * _GAPS,
        agrees=_agrees,
        twice={f"gap{joint.number}": ("gap", 1)},
        starts=tuple(
            {"Iam": inertia, "gap": gap, "k": stiffness, "damping": damping}
            for inertia, stiffness, damping, gap in found
        ),
    )


def _agrees(coefficients: Array, shape: Mapping[str, float]) -> bool:
    """Whether the size of the torque tells nearly the gap that the time of the fall tells."""
    return bool(_ALIKE < coefficients[0] / shape["gap"] < 1 / _ALIKE)


def _closed(load: float, shape: Mapping[str, float]) -> bool:
    """Whether a gap is little beside what the drive train gives way under the rms of its ``load`` [N m, N]."""
    return shape["gap"] <= _OPEN * load / shape["k"]


def _changes_sign(side: LinkSide) -> bool:
    return bool(np.any(side.load > 0) and np.any(side.load < 0))


def _gaps(side: LinkSide) -> tuple[float, float]:
    """The narrowest and the widest gap that is looked for: M e'' = -tau_link' t, so e = tau_link' t^3 / (6 M)."""
    slope = rms(side.scene.derivative(side.load))
    each = slope / (6 * float(np.mean(side.inertia)))
    return each * _QUICKEST**3, each * _SLOWEST**3


def _has_gap(robot: Robot, number: int) -> bool:
    uses = [use for use in robot.effects if use.effect == "joint_elasticity" and number in use.joints]
    return any("gap" in use.values for use in uses)


def _columns(sides: LinkSides, scene: Scene, shape: Mapping[str, float]) -> Array:
    side = sides.along(scene, shape["Iam"])
    train, spread = Train(shape["k"], shape["damping"], shape["gap"]), float(np.std(side.load))
    played = [side.torque_per(side.loaded(part * spread).deflection(train)) for part in ERRORS]
    return np.asarray(np.mean(played, axis=0)[None] / shape["gap"])
