"""A drive that clips its current while the log holds what was asked for.

What the log holds too much is what the recorded current is beyond the limit, to either side. By the model the
coefficient is 1; less is a limit that gives way a little. Noise of the recorded current exceeds a limit as well, and is
missing in the model: what is not clearly more than noise does not count, and where much of it is the motion's own the
coefficient is small.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from scipy.ndimage import binary_opening

from identification.arrays import Array
from identification.corrections import NEVER, drifting
from identification.diagnosis.columns.hypothesis import SIGNAL, Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import constants, coupling, motor_torques
from identification.residuals import MEDIAN_SIZE, rms

#: Parts of a run's samples that stay below the lowest and the highest limit that is tried.
_LOWEST, _HIGHEST = 0.8, 0.999
#: Of what exceeds the limit, the least part that must be missing.
_LEAST = 0.8
#: Time [s] for which a limit clips at least: what is shorter is a sample gone wrong.
_LASTS = 0.02
#: How many times the noise what exceeds the limit must be, in its rms.
_CLEAR = 3.0


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a motor whose torque constant is known, without those whose limit the robot's file states."""
    if not scenes or scenes[0].robot.drives is None or not scenes[0].robot.drives.torque_constants:
        return []
    robot = scenes[0].robot
    stated = robot.signals.current_limit
    found = []
    for k, joint in enumerate(robot.moving):
        low, high = np.quantile(
            np.concatenate([np.abs(_current(scene, k, scene.tau)) for scene in scenes]), [_LOWEST, _HIGHEST]
        )
        if (stated and stated[k] < NEVER) or not 0 < low < high:
            continue
        # Where all of the current hardly exceeds the noise nothing is told of a limit.
        if not any(_columns(k, scene, {"current_limit": float(low)}).any() for scene in scenes):
            continue
        found.append(
            Hypothesis(
                "current_limit",
                "current saturation",
                joint.number,
                (Coefficient(f"clipped{joint.number}", "1", _LEAST, 1.25),),
                partial(_columns, k),
                shapes=(ShapeRange("current_limit", "A", float(low), float(high), 8),),
                kind=SIGNAL,
                joints=(joint.number,),
                variable="load",
                would_show="stronger accelerations, or the current that flowed instead of the one that was asked for",
                separating={
                    "torque_gain": "gentler motion: below the limit nothing is missing, a gain is missing everywhere",
                },
                recorded=True,
            )
        )
    return found


def _columns(k: int, scene: Scene, shape: Mapping[str, float]) -> Array:
    current = _current(scene, k, scene.tau)
    limit = shape["current_limit"]
    excess = _lasting(current - np.clip(current, -limit, limit), scene.period)
    over = excess != 0
    # Noise may be as slow as the motion is: it is all that the model leaves where nothing is clipped.
    noise = _current(scene, k, scene.tau - scene.torque)[~over]
    clear = _CLEAR * np.median(np.abs(noise)) / MEDIAN_SIZE if noise.size else np.inf
    if not over.any() or rms(excess[over]) < clear:
        excess = np.zeros_like(excess)
    return np.outer(coupling(scene.robot)[k], _torque_per_recorded(scene, k) * excess)[None]


def _lasting(excess: Array, period: float) -> Array:
    """Without stretches that are too short to be told from samples gone wrong."""
    shortest = np.ones(max(2, round(_LASTS / period)), dtype=bool)
    return np.where(binary_opening(excess != 0, shortest), excess, 0.0)


def _current(scene: Scene, k: int, torque: Array) -> Array:
    """The recorded current of a motor [A] (N) for true torques of the joints (n x N)."""
    return np.asarray(motor_torques(scene.robot, torque)[k] / _torque_per_recorded(scene, k))


def _torque_per_recorded(scene: Scene, k: int) -> Array:
    """True torque of a motor per recorded current (N) [N m/A], with the gain and the drift that the robot's file
    states.
    """
    robot, warmth = scene.robot, scene.motion.warmth
    gain = robot.signals.torque_gain
    result = np.full(scene.motion.samples, float(constants(robot)[k]) * (float(gain[k]) if gain else 1.0))
    drift = dict(drifting(robot)).get(k, 0.0)
    return result * (1 + drift * warmth[k]) if drift and warmth is not None else result
