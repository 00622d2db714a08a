"""What a small change of the motion does to the model's torque."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from identification.arrays import Array
from identification.diagnosis.runs.scene import Scene
from identification.observation import Motion

#: Largest change of a position [rad, m] by which sensitivities are found.
_STEP = 1e-4


def sensitivity(torque_on: Callable[[Motion], Array], motion: Motion, change: Motion, about: float = 0.0) -> Array:
    """Torque (n x N) per unit of ``change`` of the motion, by a central difference; between none and ``about`` times
    the change where that is known to be near.

    ``change`` holds what is added to positions, speeds and accelerations. Speeds and accelerations enter the torque
    up to their squares, but for the signs of friction: the step is small in the positions alone.
    """
    if about:
        return (torque_on(moved(motion, change, about)) - torque_on(motion)) / about
    largest = float(np.abs(change.q).max())
    step = _STEP / largest if largest > 0 else 1.0
    return (torque_on(moved(motion, change, step)) - torque_on(moved(motion, change, -step))) / (2 * step)


def change_of(scene: Scene, k: int, x: Array) -> Motion:
    """Coordinate ``k`` moved by ``x`` (N), its speed and acceleration by the derivatives of ``x``."""
    speed = scene.derivative(x)
    return alone(scene.motion, k, (x, speed, scene.derivative(speed)))


def scaled(scene: Scene, k: int, factor: float) -> Motion:
    """The change that is ``factor`` times the motion of coordinate ``k``."""
    return alone(scene.motion, k, [factor * x[k] for x in scene.motion.signals])


def alone(motion: Motion, at: int | list[int], signals: Iterable[ArrayLike]) -> Motion:
    """The change of a motion whose coordinates ``at`` alone have positions, speeds and accelerations."""
    moved = []
    for x in signals:
        moved.append(np.zeros_like(motion.q))
        moved[-1][at] = x
    return Motion(*moved)


def quicker(motion: Motion, k: int) -> Motion:
    """The motion with one more unit of acceleration of coordinate ``k``."""
    qdd = motion.qdd.copy()
    qdd[k] += 1.0
    return replace(motion, qdd=qdd)


def moved(motion: Motion, change: Motion, step: float) -> Motion:
    """The motion with ``step`` times a change added."""
    return replace(
        motion, q=motion.q + step * change.q, qd=motion.qd + step * change.qd, qdd=motion.qdd + step * change.qdd
    )
