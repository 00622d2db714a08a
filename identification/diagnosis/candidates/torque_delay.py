"""Torques that are recorded later than positions: tau_recorded(t) = tau(t - s).

At first that is tau(t) - s dtau/dt; a long delay is told by motors' rows (``lateness``), its column is a secant.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from generator.robot.description import Joint
from identification.arrays import Array
from identification.corrections import earlier
from identification.diagnosis.columns.confirmed import confirmed
from identification.diagnosis.columns.hypothesis import BEYOND, SIGNAL, Coefficient, Hypothesis
from identification.diagnosis.columns.lateness import (
    LONGEST,
    Lateness,
    Latenesses,
    closer,
    delay_of,
    latenesses,
    torques,
)
from identification.diagnosis.runs.prepared import windowed
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import supplied
from identification.outcome import Value

#: Part of a delay to which rows must tell it, where they do not tell that there is one.
_CLOSELY = 0.1
#: Noise of the record's own in a column, in parts of what the delay makes of it, that it may have.
_NOISY = 1.0


@dataclass(frozen=True)
class _Told:
    """A delay ``beyond`` another; motors' ``late`` rows tell it, and of each what it is late by, ``whole`` [s] (n)."""

    beyond: Value
    late: Sequence[Lateness | None]
    whole: Sequence[float]


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One delay of all torques, and one of each motor's own, beyond those that the robot's file states.

    The coefficient adds to ``torque_delay`` of the file's signals; it is negative where positions come later than
    torques.
    """
    if not scenes:
        return []
    moving = scenes[0].robot.moving
    late = latenesses(scenes)
    shared = _shared(late, scenes[0].found(_name(None)))
    start = scenes[0].found(_name(None)) if shared is None else _value(shared)
    each = [delay_of([one], start) for one in late.own]
    whole = [start + _value(beyond) for beyond in each]
    together = None if shared is None else _Told(shared, late.shared, whole)
    told = [None if one is None else _Told(one, late.own, whole) for one in each]
    own = [_hypothesis(scenes, (joint,), k, start if told[k] else 0.0, told[k]) for k, joint in enumerate(moving)]
    return [_hypothesis(scenes, moving, None, 0.0, together), *(own if len(moving) > 1 else ())]


def _shared(late: Latenesses, found: float) -> Value | None:
    """The delay of all motors, where their rows tell it, or tell closely the one that was ``found`` [s] otherwise."""
    told = delay_of(late.shared)
    about = found if told is None else _value(told)
    close = closer(late.together, about) if about else None
    if close is None or (told is None and not _CLOSELY * abs(_value(close)) > close.std):
        return told
    return close


def _hypothesis(
    scenes: Sequence[Scene], joints: Sequence[Joint], k: int | None, start: float, told: _Told | None
) -> Hypothesis:
    """Of a delay beyond one of all motors that is ``start`` [s]."""
    joint, stated = None if k is None else joints[0], any(scenes[0].robot.signals.torque_delay)
    quiet = None if told is None else _quiet(scenes, k, start, told)
    return Hypothesis(
        "torque_delay",
        "delay between torque and position" + " of all joints" * (k is None) + BEYOND * stated,
        0 if joint is None else joint.number,
        (Coefficient(_name(joint), "s", -LONGEST - start, LONGEST - start),),
        partial(_columns, k, joint, start, told, quiet),
        kind=SIGNAL,
        preset={} if told is None else {_name(joint): told.beyond},
        beyond=(_name(None),) if start else (),
        joints=tuple(one.number for one in joints),
        variable="frequency",
        would_show="quick changes of torque: higher frequencies, steps of the acceleration",
        separating={
            "joint_elasticity": "speed steps at constant load: a delay shows at every step alike, "
            "elasticity by the load's inertia",
            "viscous_friction": "the same motion twice as fast: a delay of inertia's torque grows with the cube of the "
            "speed, viscous friction with the speed",
            "gradual_friction": "slow reversals: a delay shifts the reversal by a time, gradual friction by a speed",
            "dahl_friction": "slow reversals: a delay shifts the reversal by a time, presliding by a way",
        },
    )


def _name(joint: Joint | None) -> str:
    return "torque_delay" if joint is None else f"torque_delay{joint.number}"


def _value(told: Value | None) -> float:
    """Of what is told, 0 of nothing."""
    return (told.value if told else None) or 0.0


def _columns(
    k: int | None,
    joint: Joint | None,
    start: float,
    told: _Told | None,
    quiet: NDArray[np.bool_] | None,
    scene: Scene,
    shape: Mapping[str, float],
) -> Array:
    """What a delay beyond one of ``start`` [s] changes per second of it: as long as was ``told``, of recorded torques
    on joints that are ``quiet`` (n), else as was found, else as none, of the model's torque as the recorded one
    confirms it.
    """
    if told is not None and quiet is not None:
        recorded, modelled, known = _two_secants(scene, k, start, told)
        return np.where(quiet[:, None] & known, recorded, modelled)[None]
    found = scene.found(_name(joint))
    recorded, modelled = (_of_motor(scene, k, tau) for tau in (scene.sampled.tau, scene.torque))
    common = 0.0 if joint is None or start else scene.found(_name(None))
    tau = confirmed(modelled, recorded, scene.period, start + common + found)
    return (_secant(scene, tau, start, found) if found else -scene.derivative(tau))[None]


def _two_secants(scene: Scene, k: int | None, start: float, told: _Told) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Of the recorded torque, which is late already, and of the model's (n x N); and where the recorded one is known as
    much later (N).
    """
    more, name = _value(told.beyond), _name(None if k is None else scene.robot.moving[k])
    motors = range(len(scene.robot.moving)) if k is None else (k,)
    tau = scene.torque if scene.found(name) else torques(scene, told.late, told.whole, motors)
    recorded = _secant(scene, _of_motor(scene, k, scene.sampled.tau), -more, more)
    later = np.arange(scene.motion.samples) + more / scene.period
    known = (later >= 0) & (later <= scene.motion.samples - 1)
    return recorded, _secant(scene, _of_motor(scene, k, tau), start, more), known


def _of_motor(scene: Scene, k: int | None, tau: Array) -> Array:
    """The part of torques (n x N) that motor k supplies; all of them where it is None."""
    return tau if k is None else supplied(scene.robot, k, tau)


def _secant(scene: Scene, tau: Array, start: float, more: float) -> Array:
    """What a delay of ``start`` and ``more`` [s] makes of torques (n x N) beyond one of ``start``, per second of it."""
    before, after = (earlier(tau, [-delay] * len(tau), scene.period) for delay in (start, start + more))
    return (after - before) / more


def _quiet(scenes: Sequence[Scene], k: int | None, start: float, told: _Told) -> NDArray[np.bool_]:
    """The joints (n) on which the recorded torque is the quieter one along all runs."""
    kept = []
    for scene in scenes:
        recorded, modelled, known = _two_secants(scene, k, start, told)
        factor = scene.sampled.filters.factor
        clear = windowed((scene.sampled.left_out | ~known).astype(float), factor) == 0
        kept.append(np.stack([np.where(clear, windowed(one, factor), 0.0) for one in (recorded, modelled)]))
    return _quieter(*np.concatenate(kept, axis=-1))


def _quieter(recorded: Array, modelled: Array) -> NDArray[np.bool_]:
    """On which joints rows of the recorded torque (n x N) have little noise, and less than those of the model's, which
    have that of the positions: what both have in common is none.
    """
    common, power = np.sum(recorded * modelled, axis=1), np.sum(recorded**2, axis=1)
    return np.asarray((power < (1 + _NOISY) * common) & (power < np.sum(modelled**2, axis=1)))
