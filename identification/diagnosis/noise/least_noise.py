"""The least that counts as noise: no model is truer, nor are filters and differences, though a simulation has none."""

from __future__ import annotations

from math import sqrt

import numpy as np

from identification.arrays import Array
from identification.diagnosis.runs.prepared import Prepared

#: Its rms, in parts of the joint's torque.
_PART = 1e-5


def deviations(run: Prepared) -> Array:
    """Its standard deviations (n) [N m, N]."""
    return np.asarray(_PART * np.sqrt(np.mean(run.tau**2, axis=-1)))


def least(run: Prepared, number: int) -> Array:
    """White torques (n x rows) [N m, N] of that size, draw ``number``: periods have them in common, as noise that they
    do not have would be.
    """
    drawn = np.random.default_rng(number).normal(size=run.tau.shape)
    return np.asarray(sqrt(max(run.times, 1.0)) * deviations(run)[:, None] * drawn)
