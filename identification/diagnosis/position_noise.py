"""White noise of recorded positions: how much there is, and what a draw of it makes of the motion and its torques."""

from __future__ import annotations

from math import comb, sqrt

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.perturbation import sensitivity
from identification.diagnosis.scene import Scene
from identification.filtering import flat_derivative, smoothed
from identification.observation import Motion

Array = NDArray[np.float64]

#: Order of the differences that leave nothing of a motion, and the median of a normal deviate's size.
_ORDER, _MEDIAN = 8, 0.6745
#: Part of a position that is the rounding of its arithmetic.
_ARITHMETIC = 1e-11


def deviations(q: Array) -> Array:
    """Standard deviation (n) [rad, m] of the white noise of recorded positions (n x N), zero where there is none.

    Differences of high order leave what is quick alone (Rice, Annals of Statistics 12, 1984); their median does not
    see the instants at which an acceleration jumps.
    """
    rough = np.abs(np.diff(q, _ORDER, axis=-1))
    found = np.median(rough, axis=-1) / (_MEDIAN * sqrt(comb(2 * _ORDER, _ORDER)))
    return np.asarray(np.where(found > _ARITHMETIC * np.abs(q).max(axis=-1), found, 0.0))


def drawn(scene: Scene, deviations: Array, number: int) -> Motion:
    """What white noise of positions, of standard deviations (n) [rad, m], may add to the motion: draw ``number``."""
    one = scene.sampled
    error = np.random.default_rng(number).normal(size=one.run.q.shape) * deviations[:, None]
    q = smoothed(error, one.filters.order, one.filters.cutoff, one.run.rate)
    qd = flat_derivative(q, one.run.period)
    first = one.filters.first
    return Motion(q, qd, flat_derivative(qd, one.run.period)).part(first, first + one.motion.samples)


def torque_of(error: Motion, scene: Scene) -> Array:
    """What a small error of the motion makes of the torques (n x N) [N m, N] of the model and of what was found."""
    return sensitivity(scene.torque_on, scene.motion, error)
