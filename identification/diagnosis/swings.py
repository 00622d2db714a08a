"""Which elastic drive train makes a link swing as the log has it: many are played at once.

A lightly damped swing answers to one stiffness alone, and what crosses a gap to one gap: a coarse grid of shapes would
miss both. What is compared is the largest part of a swing's torque, the inertia of the joint's own link, with what the
model leaves of the joint's torque.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.link_side import LinkSide, Train, rotor_inertia
from identification.diagnosis.scene import Scene

Array = NDArray[np.float64]

#: Samples that are played, of the run in which the joint is fastest.
_SAMPLES = 6000
#: Frequencies [Hz] of a link on its drive train, the motor held, and their largest part of the samples' rate, which the
#: integration can follow.
_LOWEST, _HIGHEST, _PART = 3.0, 100.0, 0.125
#: Damping ratios.
DAMPING = (0.01, 0.15)
#: Values about the best of a grid among which it is refined.
_FINER = 7


def watched(scenes: Sequence[Scene], k: int) -> bool:
    """Whether a link has an encoder of its own, which tells an elastic drive train without any torque."""
    return any(f"qs{scenes[0].robot.moving[k].number}" in scene.sampled.run.others for scene in scenes)


def liveliest(scenes: Sequence[Scene], k: int) -> LinkSide | None:
    """The joint's link side in the run in which it is fastest; None where the model's link has no inertia."""
    scene = max(scenes, key=lambda one: float(np.mean(one.motion.qd[k] ** 2)))
    side = LinkSide(scene, k, rotor_inertia(scene, k))
    return side if np.min(side.inertia) > 0 and np.any(side.load) else None


def stiffnesses(side: LinkSide) -> tuple[float, float]:
    """The softest and the stiffest drive train that is looked for [N m/rad, N/m]."""
    highest = min(_HIGHEST, _PART / side.scene.period)
    inertia = float(np.mean(side.inertia))
    low, high = (inertia * (2 * np.pi * f) ** 2 for f in (_LOWEST, highest))
    return float(low), float(high)


def best(side: LinkSide, grids: Sequence[Array]) -> tuple[float, ...]:
    """Stiffness, damping and gap, each from its grid in geometric steps, that are most like the log; then between the
    steps.
    """
    found = _most_alike(side, grids)
    return _most_alike(side, [_about(x, grid) for x, grid in zip(found, grids, strict=True)])


def _about(x: float, grid: Array) -> Array:
    """Values from one step of a grid below x to one above it."""
    if len(grid) == 1:
        return grid
    step = grid[1] / grid[0]
    return np.geomspace(max(x / step, grid[0]), min(x * step, grid[-1]), _FINER)


def _most_alike(side: LinkSide, grids: Sequence[Array]) -> tuple[float, ...]:
    """The combination whose swing has the largest cosine with the residual."""
    stiffness, damping, gap = (x.reshape(-1) for x in np.meshgrid(*grids, indexing="ij"))
    left = (side.scene.tau - side.scene.model_torque)[side.k]
    product, size = np.zeros((2, len(stiffness)))
    played = side.steps(Train(stiffness, damping, gap), _SAMPLES)
    # A drive train too stiff for the samples runs away; it is like nothing.
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for y, M, a in zip(left.tolist(), side.inertia.tolist(), played, strict=False):
            torque = M * a
            product += y * torque
            size += torque * torque
        alike = product / np.sqrt(size)
    most = int(np.argmax(np.where(np.isfinite(alike), alike, -1.0)))
    return float(stiffness[most]), float(damping[most]), float(gap[most])
