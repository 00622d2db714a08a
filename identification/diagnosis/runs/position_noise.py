"""White noise of recorded positions: how much there is, and what a draw of it makes of the motion and its torques."""

from __future__ import annotations

from math import comb, sqrt

import numpy as np

from identification.arrays import Array
from identification.diagnosis.runs.perturbation import sensitivity
from identification.diagnosis.runs.scene import Scene
from identification.filtering import flat_derivative, smoothed
from identification.neighbours import ARITHMETIC
from identification.observation import Motion
from identification.residuals import MEDIAN_SIZE

#: Order of the differences that leave nothing of a motion.
_ORDER = 8
#: Samples between those that are compared, at most: what was logged more slowly repeats, or lies on lines; and the part
#: of the noise that those farther apart have where it is not white.
_STRIDES, _WHITE = 25, 0.8


def deviations(q: Array) -> Array:
    """Standard deviation (n) [rad, m] of the white noise of recorded positions (n x N), zero where there is none.

    Differences of high order leave what is quick alone (Rice, Annals of Statistics 12, 1984); their median does not
    see the instants at which an acceleration jumps. White noise is as large in every second sample as in all.
    """
    every, *apart = (_rough(q, stride) for stride in range(1, _STRIDES + 1))
    least = np.min(apart, axis=0)
    found = np.where(least < _WHITE * every, least, every)
    found[np.isinf(found)] = 0.0
    return np.asarray(np.where(found > ARITHMETIC * np.abs(q).max(axis=-1), found, 0.0))


def _rough(q: Array, stride: int) -> Array:
    """The deviation of white noise in samples of which those ``stride`` apart are compared, infinite where there are
    too few.
    """
    if q.shape[-1] <= _ORDER * stride:
        return np.full(len(q), np.inf)
    rough = q
    for _ in range(_ORDER):
        rough = rough[:, stride:] - rough[:, :-stride]
    return np.asarray(np.median(np.abs(rough), axis=-1) / (MEDIAN_SIZE * sqrt(comb(2 * _ORDER, _ORDER))))


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
