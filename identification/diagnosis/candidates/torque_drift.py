"""Torque constants that change while a motor gets warm: true torque = (1 + start)(1 + drift w) recorded.

The warmth w is that of the robot's file. Where that says nothing, it is 1 - exp(-t/T) from a cold start, or what the
square of the motor's torque has heated since then, or a temperature's rise where the runs have one.
``drift`` adds to ``torque_drift`` of the robot's drives, d: (1 + d w)(1 + drift w/(1 + d w)) is 1 + (d + drift) w. With
``start`` the constant differs already where w is 0.

The true torque is linear in both, what is recorded is not: columns are of the torque that is recorded, not of the true
one, as soon as an earlier search has found a drift, and a large one is exact. From then on each run also tells how much
warmer the drive was when it began: all that fades from there belongs to that run alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from generator.robot.description import Joint
from identification.arrays import Array
from identification.corrections import by_heat, drifting
from identification.diagnosis.columns.hypothesis import BEYOND, DRIVE, Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.columns.warming import following, warm_up_times
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import motor_torques, supplied
from identification.residuals import rms

#: What is found, as section drives of the robot file calls it.
EFFECT = "torque_drift"
#: Of what is found, and of that and what the file states.
_LARGEST, _WHOLE = 0.6, 0.95
#: Of the warmth, in what part of a torque is recorded.
_DEGREE = 3
#: Rise of a temperature [K] below which nothing has got warm.
_RISE = 2.0

#: What a motor supplies to its joint by the model and by the log (N each), and the samples (N) that tell of it.
_Torques = tuple[Array, Array, NDArray[np.bool_]]


def drift_name(joint: Joint) -> str:
    """How the coefficient of a motor's drift is called."""
    return f"{EFFECT}{joint.number}"


def start_name(joint: Joint) -> str:
    """How that of the part is called by which the constant differs already where it is cold."""
    return f"start{joint.number}"


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """By the warmth of the file, else by time, by the heat of the motor and, where every run has the joint's
    temperature, by that too.
    """
    if not scenes or scenes[0].robot.drives is None:
        return []
    robot = scenes[0].robot
    time = warm_up_times(scenes)
    found = []
    for k, joint in enumerate(robot.moving):
        if any(scene.warmth_is_stated(k) for scene in scenes):
            stated = dict(drifting(robot)).get(k, 0.0)
            found.append(_hypothesis(k, joint, "drive's warmth", recorded=by_heat(robot, k), stated=stated))
            continue
        found.append(_hypothesis(k, joint, "time since the start", (time,)))
        usual = max(rms(scene.motor_torque(k)) for scene in scenes)
        if usual > 0:
            found.append(_hypothesis(k, joint, "motor's heat", (_exactly("warm_torque", "N m", usual), time), True))
        if temperature := _temperature(k, scenes):
            found.append(_hypothesis(k, joint, "drive's temperature", temperature))
    return found


def _temperature(k: int, scenes: Sequence[Scene]) -> tuple[ShapeRange, ...]:
    """The rise that counts as warm, and the time constant that follows the temperature best, by which the file tells
    the warmth in runs without one; none where a run has none, or nothing has got warm.
    """
    rises = [rise for scene in scenes if (rise := scene.rise(k)) is not None]
    whole = max((float(rise.max()) for rise in rises), default=0.0)
    if len(rises) < len(scenes) or whole <= _RISE:
        return ()
    nearest = following(scenes, [rise / whole for rise in rises])
    return _exactly("warm_rise", "K", whole), _exactly("warm_up_time", "s", nearest)


def _exactly(name: str, unit: str, value: float) -> ShapeRange:
    """A shape of which nothing else is tried."""
    return ShapeRange(name, unit, value, value, points=(value,))


def _hypothesis(
    k: int, joint: Joint, along: str, shapes: tuple[ShapeRange, ...] = (), recorded: bool = False, stated: float = 0.0
) -> Hypothesis:
    lower, upper = max(-_LARGEST, min(-_WHOLE - stated, 0.0)), min(_LARGEST, max(_WHOLE - stated, 0.0))
    return Hypothesis(
        EFFECT,
        f"drift of the torque constant with the {along}{BEYOND * bool(stated)}",
        joint.number,
        (
            Coefficient(drift_name(joint), "1", lower, upper, essential=True),
            Coefficient(start_name(joint), "1", -_LARGEST, _LARGEST),
        ),
        partial(_columns, k),
        shapes=shapes,
        kind=DRIVE,
        joints=(joint.number,),
        variable="time",
        would_show="one long run after a cold start, with a load that stays the same",
        separating={
            "warm_friction": "one long run with parts at constant speed and at rest: friction does not change the "
            "torque that holds a weight",
            "torque_gain": "one long run: a gain does not change with time",
        },
        of_model=partial(_of_model, k),
        recorded=recorded,
    )


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    return _scaled(k, scene, shape, scene.torque)


def _of_model(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    return _scaled(k, scene, shape, scene.model_torque)


def _scaled(k: int, scene: Scene, shape: Mapping[str, float], torque: Array) -> Array:
    own, w = supplied(scene.robot, k, torque), _warmth(k, scene, shape)
    w = w / (1 + dict(drifting(scene.robot)).get(k, 0.0) * w)
    drift, gain = _found(k, scene)
    if not drift or not np.all(np.isfinite(w)):
        return -np.stack([own * w, own])
    torques = _torques(k, scene)
    w = w + _warmer(k, scene, torques) * _fading(scene, shape)
    recorded = own * _part(k, scene, w, torques)
    return -np.stack([gain * recorded * w, recorded])


def _part(k: int, scene: Scene, w: Array, torques: _Torques) -> Array:
    """What part of its torque the log holds of a motor: a polynomial of the warmth, which follows none of the noise; by
    what was found before where no sample tells.
    """
    true, logged, told = torques
    if not told.any():
        drift, gain = _found(k, scene)
        return 1 / (gain * (1 + drift * w))
    # Beyond the warmths that it is fitted to a polynomial goes anywhere.
    powers = np.clip(w, w[told].min(), w[told].max()) ** np.arange(_DEGREE + 1)[:, None]
    part: Array = np.linalg.lstsq((powers * true)[:, told].T, logged[told], rcond=None)[0] @ powers
    return part


def warmer_at_start(k: int, scene: Scene) -> float:
    """By what warmth the drive was warmer when the recording began than is known, by what was found before: what it had
    done until then differs from run to run. No less than nothing, which is also where no sample tells.
    """
    return _warmer(k, scene, _torques(k, scene))


def _warmer(k: int, scene: Scene, torques: _Torques) -> float:
    shape = scene.shape_found(EFFECT, scene.robot.moving[k].number)
    fading = _fading(scene, shape)
    if not fading.any():
        return 0.0
    drift, gain = _found(k, scene)
    true, logged, told = torques
    per_warmth = (gain * drift * fading * logged)[told]
    missing = (true - gain * (1 + drift * _warmth(k, scene, shape)) * logged)[told]
    size = float(per_warmth @ per_warmth)
    return max(float(per_warmth @ missing) / size, 0.0) if size > 0 else 0.0


def changed_at_start(k: int, scene: Scene) -> float:
    """By what part of it, as ``warmer_at_start``, the constant of motor ``k`` has changed where the run begins."""
    shape = scene.shape_found(EFFECT, scene.robot.moving[k].number)
    return _found(k, scene)[0] * warmer_at_start(k, scene) * float(_fading(scene, shape)[0])


def since_cold(k: int, scene: Scene) -> float | None:
    """How long [s] before the run motor ``k`` started cold, as ``warmer_at_start`` has it; None where its warmth is not
    one of time alone, or no time makes as much.
    """
    shape = scene.shape_found(EFFECT, scene.robot.moving[k].number)
    if shape.keys() != {"warm_up_time"}:
        return None
    began = float(_warmth(k, scene, shape)[0]) + warmer_at_start(k, scene) * float(_fading(scene, shape)[0])
    # The first sample of a scene is not that of the run.
    return float(-shape["warm_up_time"] * np.log1p(-began) - scene.t[0]) if began < 1 else None


def _found(k: int, scene: Scene) -> tuple[float, float]:
    """The drift of a motor's torque constant, and 1 + its start, that an earlier search has found."""
    joint = scene.robot.moving[k]
    return scene.found(drift_name(joint)), 1 + scene.found(start_name(joint))


def _fading(scene: Scene, shape: Mapping[str, float]) -> Array:
    """What is left of a warmth (N) that a drive had when the recording began; nothing where its course is known."""
    known = "warm_rise" in shape or "warm_up_time" not in shape
    return np.zeros_like(scene.t) if known else np.exp(-scene.t / shape["warm_up_time"])


def _torques(k: int, scene: Scene) -> _Torques:
    """What a motor supplies to its joint by the model and by the log (N each), and the samples (N) that tell of it.

    Where a joint stands of whose torque that is made, the model knows no friction.
    """
    made_of = motor_torques(scene.robot, np.eye(len(scene.tau)))[k] != 0
    true, logged = (supplied(scene.robot, k, torque)[k] for torque in (scene.torque, scene.tau))
    return true, logged, ~scene.sampled.left_out[made_of].any(axis=0)


def _warmth(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    if "warm_torque" in shape:
        return scene.heat(k, shape["warm_torque"], shape["warm_up_time"])
    if "warm_rise" not in shape:
        return scene.warmth(k, shape.get("warm_up_time"))
    rise = scene.rise(k)
    return np.full(scene.motion.samples, np.nan) if rise is None else rise / shape["warm_rise"]
