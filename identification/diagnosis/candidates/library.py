"""The generator's library of effects on every joint that can carry them: what it names here it can emit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from generator.effects.effect import BALANCER, Effect, Shape
from generator.effects.library import library
from generator.robot.description import Joint, Robot
from identification.arrays import Array
from identification.corrections import by_heat
from identification.diagnosis.columns.effect_columns import NEEDS, EffectColumns
from identification.diagnosis.columns.hypothesis import PRIOR, SINCE_REVERSAL, Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.columns.orders import LOWEST, likely_orders
from identification.diagnosis.columns.warming import warm_up_times
from identification.diagnosis.runs.rotor import rotor_inertia, usual_rotor
from identification.diagnosis.runs.scene import Scene

Coordinates = NDArray[np.int64]

#: Part of the largest weight torque's swing that a joint must see to be a place for a balancer.
_WEIGHT = 0.05
#: The same part that the joint which carries the arm has at least though a balancer takes up most of it, and the axis
#: below it has not where the base leans a little.
_CARRIES = 0.3
#: Part of the swing of the joint's whole torque that it must be.
_FELT = 0.01
#: Part of a whole warming up that the runs must show.
_WARMING = 0.2
#: A usual time constant of the warmth [s], by which the runs are judged where the robot's file says nothing of it.
_WARM_UP = 60.0
#: Friction whose values of a file may be of a warm drive.
_RUBBING = frozenset({"viscous_friction", "coulomb_friction"})
#: Step of the logarithm of a shape that is searched between ends from one point.
_STEP = 0.7
#: What an effect shows in, by what its columns are made of; the first that fits.
_VARIABLES = (
    ("warmth", "time"),
    ("load", "load"),
    ("motor", "motor phase"),
    ("state", SINCE_REVERSAL),
    ("qdd", "qdd"),
)


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """Each effect of the library on each joint that moves and is without it."""
    if not scenes:
        return []
    robot = scenes[0].robot
    swing = np.max([np.ptp(scene.weight, axis=-1) for scene in scenes], axis=0)
    alike = _alike(robot)
    weighty = {k for own in alike for k in _weighty(scenes, swing, own)}
    shoulders = {k for own in alike for k in _shoulders(swing, own)}
    return [
        one
        for effect in library().values()
        for k, joint in enumerate(robot.moving)
        if any(scene.moves(k) for scene in scenes)
        if _possible(effect, joint, robot) and (effect.role != BALANCER or k in weighty)
        if "warmth" not in effect.needs or _warming(k, scenes)
        for one in on_joint(effect, joint, k, scenes, effect.role != BALANCER or k in shoulders)
    ]


def _possible(effect: Effect, joint: Joint, robot: Robot) -> bool:
    there = _there(joint, robot)
    if effect.id in there or joint.sigma not in effect.kinds or not set(effect.needs) <= NEEDS:
        return False
    if "motor" in effect.needs and robot.drives is None:
        return False
    if any(not shape.tried and shape.default is None for shape in effect.shapes):
        return False
    return not (effect.observables and any(library()[one].observables for one in there))


def _there(joint: Joint, robot: Robot) -> set[str]:
    """Ids of the effects that a joint has."""
    return {use.effect for use in robot.effects if joint.number in use.joints}


def _alike(robot: Robot) -> list[Coordinates]:
    """Coordinates of joints whose torques compare: those that turn, and those that slide."""
    kinds = np.array([joint.sigma for joint in robot.moving])
    return [np.flatnonzero(kinds == kind) for kind in np.unique(kinds)]


def _shoulders(swing: Array, alike: Coordinates) -> set[int]:
    """Joints of those ``alike`` that a balancer is expected on, by the swing (n) of the weight's torque: the one that
    carries most, and the first that carries much, of which a balancer that is not known may hide a part.
    """
    most = float(swing[alike].max())
    carrying = alike[swing[alike] > _CARRIES * most]
    return {int(alike[np.argmax(swing[alike])]), *carrying[:1].tolist()} if most else set()


def _weighty(scenes: Sequence[Scene], swing: Array, alike: Coordinates) -> set[int]:
    """Joints of those ``alike`` on which the bodies' weight changes with the position: where a balancer makes sense."""
    torque = np.max([np.ptp(scene.tau, axis=-1) for scene in scenes], axis=0)
    return {k for k in alike.tolist() if swing[k] > max(_WEIGHT * swing[alike].max(), _FELT * torque[k])}


def _warming(k: int, scenes: Sequence[Scene]) -> bool:
    """Whether the runs show a drive at different warmths."""
    time = None if _told(k, scenes) else _WARM_UP
    return bool(np.ptp(np.concatenate([scene.warmth(k, time) for scene in scenes])) > _WARMING)


def _told(k: int, scenes: Sequence[Scene]) -> bool:
    """Whether the robot's file tells a drive's warmth; runs for which it does not show nothing then."""
    return any(scene.warmth_is_stated(k) for scene in scenes)


def on_joint(effect: Effect, joint: Joint, k: int, scenes: Sequence[Scene], usual: bool) -> list[Hypothesis]:
    """The effect on a joint, coordinate k; none where a shape has no value to begin with."""
    columns = EffectColumns(effect, joint, k, scenes[0].robot)
    shapes: list[ShapeRange] = []
    if "warmth" in effect.needs and not _told(k, scenes):
        shapes.append(warm_up_times(scenes))
    tries = shapes[0].count if shapes else 1
    for shape in effect.shapes:
        points = _begun(shape, k, scenes)
        if shape.tried and not points and shape.default is None:
            return []
        if points:
            shapes.append(_range(shape, joint, k, scenes, points))
            tries *= shape.several or len(points)
    from_the_start = "warmth" in effect.needs and _there(joint, scenes[0].robot) >= _RUBBING
    sought = {one.name for one in shapes}
    given = {
        one.name: float(one.default) for one in effect.shapes if one.name not in sought and one.default is not None
    }
    return [
        Hypothesis(
            effect.id,
            effect.title,
            joint.number,
            _coefficients(effect, joint, from_the_start),
            columns.from_the_start if from_the_start else columns,
            shapes=tuple(shapes),
            given=given,
            units={one.name: one.unit_on(joint) for one in effect.shapes},
            joints=(joint.number,),
            variable=_variable(effect),
            would_show=_would_show(effect),
            tries=tries,
            recorded="warmth" in effect.needs and by_heat(scenes[0].robot, k),
            usual=usual,
            of_motion="load" not in effect.needs,
            of_beginning=columns.of_beginning if effect.states else None,
        )
    ]


def _begun(shape: Shape, k: int, scenes: Sequence[Scene]) -> tuple[float, ...]:
    """The values of a shape at which a search begins; none where it has no such."""
    if not shape.tried:
        return ()
    return likely_orders(scenes, k, shape.several) if shape.several else _points(shape, shape.tried, k, scenes)


def _range(shape: Shape, joint: Joint, k: int, scenes: Sequence[Scene], points: tuple[float, ...]) -> ShapeRange:
    """What a search goes through from ``points``."""
    even = shape.relative == "position" or min(points) <= 0
    low = LOWEST if shape.several else min(points)
    found = ShapeRange(shape.name, shape.unit_on(joint), low, max(points), log=not even, points=points)
    if shape.within:
        low, high = _points(shape, shape.within, k, scenes)
        found = replace(found, low=low, high=high, step=_STEP)
    return replace(found, whole=shape.whole, exact=shape.exact, scale=shape.scale)


def _coefficients(effect: Effect, joint: Joint, from_the_start: bool) -> tuple[Coefficient, ...]:
    """Those of the effect, and of what it makes at the start, where that is another part of what the file tells."""
    own = tuple(
        Coefficient(f"{one.stem}{joint.number}", one.unit(joint), one.lower, one.upper, refines=one.refines)
        for one in effect.parameters
    )
    if not from_the_start:
        return own
    return own + tuple(
        Coefficient(f"{one.stem}_start{joint.number}", one.unit(joint), refines=True) for one in effect.parameters
    )


def _points(shape: Shape, values: Sequence[float], k: int, scenes: Sequence[Scene]) -> tuple[float, ...]:
    """The values, in units of what the shape is relative to; none where that is not known."""
    zero, unit = 0.0, 1.0
    if shape.relative == "rotor":
        unit = rotor_inertia(scenes[0], k) or usual_rotor(scenes[0], k)
        if unit <= 0:
            return ()
    if shape.relative == "speed":
        unit = float(max(np.abs(scene.motion.qd[k]).max() for scene in scenes))
    elif shape.relative in ("position", "way"):
        q = np.concatenate([scene.motion.q[k] for scene in scenes])
        middle, half = float(q.max() + q.min()) / 2, float(np.ptp(q)) / 2
        zero, unit = (middle, half) if shape.relative == "position" else (0.0, min(half, 1.0))
    return tuple(zero + unit * one for one in values)


def _variable(effect: Effect) -> str:
    for need, variable in _VARIABLES:
        if need in effect.needs:
            return variable
    if "q" in effect.needs:
        return "q by direction" if "qd" in effect.needs else "q"
    return "qd" if "qd" in effect.needs else "torque"


def _would_show(effect: Effect) -> str:
    """What data show an effect that a fit has taken up."""
    shows: Mapping[str, str] = {
        "qd": "slow and fast parts in both directions of the joint",
        "q": f"a larger range of the joint, or {PRIOR}",
        "qdd": f"stronger accelerations, or {PRIOR}",
        "torque": f"motion in both directions, or {PRIOR}",
        "load": "the same motion with and without a payload",
        "time": "one long run after a cold start",
        "motor phase": "slow motion at constant speed",
        SINCE_REVERSAL: "slow reversals, sampled fast, with known friction",
        "q by direction": "slow motion with reversals over the joint's whole range",
    }
    return shows[_variable(effect)]
