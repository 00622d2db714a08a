"""What a small change of the motion does to the model's torque."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.scene import Scene
from identification.observation import Motion

Array = NDArray[np.float64]

#: Largest change of a position [rad, m] by which sensitivities are found.
_STEP = 1e-4


def sensitivity(torque_on: Callable[[Motion], Array], motion: Motion, change: Motion, about: float = 0.0) -> Array:
    """Torque (n x N) per unit of ``change`` of the motion, by a central difference; between none and ``about`` times
    the change where that is known to be near.

    ``change`` holds what is added to positions, speeds and accelerations. Speeds and accelerations enter the torque
    up to their squares, but for the signs of friction: the step is small in the positions alone.
    """
    if about:
        return (torque_on(_moved(motion, change, about)) - torque_on(motion)) / about
    largest = float(np.abs(change.q).max())
    step = _STEP / largest if largest > 0 else 1.0
    return (torque_on(_moved(motion, change, step)) - torque_on(_moved(motion, change, -step))) / (2 * step)


def change_of(scene: Scene, k: int, x: Array) -> Motion:
    """Coordinate ``k`` moved by ``x`` (N), its speed and acceleration by the derivatives of ``x``."""
    moved = [np.zeros_like(scene.motion.q) for _ in range(3)]
    for signal in moved:
        signal[k] = x
        x = scene.rate(x)
    return Motion(*moved)


def scaled(scene: Scene, k: int, factor: float) -> Motion:
    """The change that is ``factor`` times the motion of coordinate ``k``."""
    moved = [np.zeros_like(scene.motion.q) for _ in range(3)]
    for signal, x in zip(moved, (scene.motion.q, scene.motion.qd, scene.motion.qdd), strict=True):
        signal[k] = factor * x[k]
    return Motion(*moved)


def _moved(motion: Motion, change: Motion, step: float) -> Motion:
    return replace(
        motion, q=motion.q + step * change.q, qd=motion.qd + step * change.qd, qdd=motion.qdd + step * change.qdd
    )
