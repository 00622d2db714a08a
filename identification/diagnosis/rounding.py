"""What the steps of recorded positions make of the joints' torques.

An acceleration of rounded positions is wrong by far more than they are, and where a motion repeats so do the errors of
rounding: what periods have in common is then no sign that the model lacks anything.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.position_noise import drawn, torque_of
from identification.diagnosis.prepared import Prepared
from identification.diagnosis.scene import Scene
from identification.resolution import steps

Array = NDArray[np.float64]


def deviations(q: Array) -> Array:
    """Standard deviation (n) [rad, m] of what rounding to steps adds to positions (n x N) that cross many of them."""
    return steps(q) / sqrt(12)


def rounding(run: Prepared, scene: Scene, number: int = 0) -> Array:
    """Torques of rounding (n x rows) [N m, N] that the periods of a run have in common, as noise that they do not have
    would be: draw ``number`` for positions that cross many steps. Zero without steps, and where nothing repeats.
    """
    rounded = deviations(scene.sampled.run.q) if run.times else np.zeros(1)
    if not rounded.any():
        return np.zeros_like(run.tau)
    return np.asarray(sqrt(run.times) * run.decimated(torque_of(drawn(scene, rounded, number), scene)))
