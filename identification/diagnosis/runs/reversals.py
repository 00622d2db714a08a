"""When a joint last turned round."""

from __future__ import annotations

import numpy as np

from identification.arrays import Array
from identification.diagnosis.runs.scene import Scene


def since_reversal(scene: Scene, k: int) -> Array:
    """Time since the speed of coordinate ``k`` last changed its sign, to or from zero too [s] (N)."""
    sign = np.sign(scene.motion.qd[k])
    number = np.arange(len(sign))
    turned = np.concatenate([[True], sign[1:] != sign[:-1]])
    return np.asarray((number - np.maximum.accumulate(np.where(turned, number, 0))) * scene.period)
