"""What the steps of recorded positions make of the joints' torques.

An acceleration of rounded positions is wrong by far more than they are, and where a motion repeats so do the errors of
rounding: what periods have in common is then no sign that the model lacks anything.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.perturbation import sensitivity
from identification.diagnosis.prepared import Prepared
from identification.diagnosis.scene import Scene
from identification.filtering import flat_derivative, smoothed
from identification.observation import Motion

Array = NDArray[np.float64]

#: Part of a step within which differences of rounded positions are whole steps, and how many there must be.
_WHOLE, _COUNT = 0.02, 100
#: Part of a signal's range that is the rounding of its arithmetic.
_ARITHMETIC = 1e-11


def steps(q: Array) -> Array:
    """The step (n) [rad, m] to which recorded positions (n x N) are rounded, zero where there is none."""
    result = np.zeros(len(q))
    for k, row in enumerate(q):
        apart = np.abs(np.diff(row))
        apart = apart[apart > _ARITHMETIC * np.abs(row).max()]
        if len(apart) < _COUNT:
            continue
        parts = apart / apart.min()
        if np.median(np.abs(parts - np.round(parts))) < _WHOLE:
            result[k] = apart.min()
    return result


def rounding(run: Prepared, scene: Scene) -> Array:
    """Torques of rounding (n x rows) [N m, N] that the periods of a run have in common, as noise that they do not have
    would be: a draw for positions that cross many steps. Zero without steps, and where nothing repeats.
    """
    one = run.sampled
    result = np.zeros_like(run.tau)
    step = steps(one.run.q)
    times = len(run.t) // run.period if run.period else 0
    if times < 2 or not step.any():
        return result
    error = np.random.default_rng(0).uniform(-0.5, 0.5, one.run.q.shape) * step[:, None]
    q = smoothed(error, one.filters.order, one.filters.cutoff, one.run.rate)
    qd = flat_derivative(q, one.run.period)
    first = one.filters.first
    change = Motion(q, qd, flat_derivative(qd, one.run.period)).part(first, first + one.motion.samples)
    torque = sensitivity(lambda motion: scene.torque_of(scene.values, motion), scene.motion, change)
    return np.asarray(np.sqrt(times) * run.decimated(torque))
