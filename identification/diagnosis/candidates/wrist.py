"""Rotors that two neighbouring joints turn: the generator's ``coupled_rotor`` on the pairs of a wrist."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from itertools import pairwise

import numpy as np
import sympy

from generator.effects.coupled_rotor import EFFECT
from generator.effects.effect import Site
from generator.robot.description import FIXED, Joint, Robot
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene
from identification.residuals import rms

#: Joints, counted from the tool, that may share a rotor.
_WRIST = 3
#: Below this share of the other joint's speed, in parts of its own where one turns and one slides, a coupled rotor is
#: the joint's own (report section 2.3.1).
_WEAKEST = 0.1
#: What a parameter shows over that is no friction.
_SHOWN = {"Iar": "qdd"}


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """Pairs among the last joints, by the ratio of the drives' coupling, which turns a rotor with both, else in the
    same and the opposite sense.

    The later joint carries the effect; none where the robot's file has a coupled rotor on it.
    """
    if not scenes:
        return []
    robot = scenes[0].robot
    return [
        _hypothesis(robot, joint, other, ratio, stated)
        for other, joint in pairwise(robot.moving[-_WRIST:])
        if not robot.has(EFFECT.id, joint.number) and _moved_by(robot, joint) == other
        for ratio, stated in _ratios(scenes, joint, other)
    ]


def _moved_by(robot: Robot, joint: Joint) -> Joint | None:
    """The moving joint that carries another, by fixed frames if any; None for the base."""
    carrier = robot.antecedent(joint)
    while carrier is not None and carrier.sigma == FIXED:
        carrier = robot.antecedent(carrier)
    return carrier


def _ratios(scenes: Sequence[Scene], joint: Joint, other: Joint) -> list[tuple[float, bool]]:
    """Speeds of the rotor per speed of the other joint, in units of that per speed of its own; whether the file says
    it.
    """
    robot = scenes[0].robot
    own, its = robot.moving.index(joint), robot.moving.index(other)
    if robot.drives is not None:
        row = robot.drives.coupling[own]
        ratio = float(row[its] / row[own])
        speeds = [1.0, 1.0] if joint.sigma == other.sigma else [_speed(scenes, k) for k in (its, own)]
        if ratio and abs(ratio) * speeds[0] >= _WEAKEST * speeds[1]:
            return [(ratio, True)]
    # A slide and a turn share no rotor unless the file says how.
    return [(1.0, False), (-1.0, False)] if joint.sigma == other.sigma else []


def _speed(scenes: Sequence[Scene], k: int) -> float:
    """Of coordinate ``k``, rms [rad/s, m/s]."""
    return rms(np.concatenate([scene.motion.qd[k] for scene in scenes]))


def _hypothesis(robot: Robot, joint: Joint, other: Joint, ratio: float, stated: bool) -> Hypothesis:
    own, its = robot.moving.index(joint), robot.moving.index(other)
    return Hypothesis(
        EFFECT.id,
        EFFECT.title,
        joint.number,
        tuple(
            Coefficient(f"{one.stem}{joint.number}", one.unit(joint), one.lower, variable=_SHOWN.get(one.stem, ""))
            for one in EFFECT.parameters
        ),
        partial(_columns, joint),
        given={"other": float(other.number), "ratio": ratio},
        joints=(other.number, joint.number),
        variable="qd",
        would_show="both joints moving at once, with and against each other",
        separating={
            "rotor_inertia": "one joint moving while the other stands: a shared rotor asks torque of both motors",
            "viscous_friction": "one joint moving while the other stands: a shared rotor asks torque of both motors",
            "coulomb_friction": "one joint moving while the other stands: a shared rotor asks torque of both motors",
        },
        stated=stated,
        jumps=tuple((k, ((its, ratio), (own, 1.0))) for k in (its, own)),
    )


def _columns(joint: Joint, scene: Scene, shape: Mapping[str, float]) -> Array:
    numbers = scene.robot.numbers
    values = {"other": sympy.Integer(int(shape["other"])), "ratio": sympy.Float(shape["ratio"])}
    signals = [sympy.Symbol(f"{stem}{number}", real=True) for stem in ("q", "qd", "qdd") for number in numbers]
    motion = scene.motion
    columns = EFFECT.columns(Site(joint, values))
    result = np.zeros((len(columns), *motion.q.shape))
    for p, column in enumerate(columns):
        for number, torque in column.items():
            law = sympy.lambdify(signals, torque, "numpy", cse=True)
            result[p, numbers.index(number)] = law(*motion.q, *motion.qd, *motion.qdd)
    return result
