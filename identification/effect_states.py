"""States inside effects along a recorded motion: the deflection of bristles, the built-up part of a hysteresis.

Their rates are stiff: a joint in motion wears a bristle's deflection down within one sample. So a step is that of an
exponential method, exact where the rate is linear in the state (Hochbruck and Ostermann, Exponential integrators, Acta
Numerica 19, 2010). All samples are computed at once: the rates are linearised about a guess of the states' whole
course, which leaves a recursion z[i+1] = a[i] z[i] + b[i]; its result is the next guess. Where rates are linear in the
state the first result is the last one.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from identification.arrays import Array
from identification.recursion import from_start

#: Rates of the states (N x s) for positions, speeds (N x n) and states (N x s).
Rates = Callable[[Array, Array, Array], Array]

#: Part of a state's decay that a step may hold, and steps a sample at most: what decays faster has no past.
_DECAY, _STEPS = 0.25, 16
#: Change of the states between two guesses that ends the iteration, and guesses at most.
_SAME, _GUESSES = 1e-9, 30
#: States are of the order of one: rates are not linearised beyond.
_FAR = 10.0
#: Difference of states that slopes are taken over.
_APART = 1e-6
#: Mean speed of the first samples, in parts of the rms, below which a joint stood before its record began.
_RESTED, _FIRST = 0.03, 10


def beginning(qd: Array) -> Array:
    """States at the beginning of a record of speeds (... x N) [rad/s, m/s], each that of a long motion the same way: 1
    or -1. Nobody knows how a joint came to rest that stands: 0.
    """
    size, first = np.sqrt(np.mean(qd**2, axis=-1)), np.mean(qd[..., :_FIRST], axis=-1)
    return np.where(np.abs(first) > _RESTED * size, np.sign(first), 0.0)


def integrated(rates: Rates, q: Array, qd: Array, period: float, start: Array) -> Array:
    """The states (s x N) from ``start`` (s) along positions and speeds (n x N) [rad, m; rad/s, m/s].

    ``period`` [s] is that of the samples. A rate may depend on its own state alone, not on another one.
    """
    count, states = q.shape[-1], len(start)
    if count < 2:
        return np.repeat(start[:, None], count, axis=-1)
    steps = _steps(rates, q.T, qd.T, period, states)
    t, fine = np.arange(count), np.arange((count - 1) * steps) / steps + 0.5 / steps
    middle_q, middle_qd = (np.stack([np.interp(fine, t, row) for row in x], axis=-1) for x in (q, qd))
    h = period / steps
    z = np.tile(start, (len(fine) + 1, 1))
    for _ in range(_GUESSES):
        about = np.clip((z[1:] + z[:-1]) / 2, -_FAR, _FAR)
        rate, slope = _linearised(rates, middle_q, middle_qd, about)
        x = h * slope
        summands = h * phi(x) * (rate - slope * about)
        new = np.stack([from_start(*one) for one in zip(np.exp(x).T, summands.T, start, strict=True)], axis=-1)
        change = np.abs(new - z).max()
        z = new
        # What has no value is told by the torque that it makes.
        if change < _SAME or not np.isfinite(change):
            return z[::steps].T.copy()
    return _one_by_one(rates, middle_q, middle_qd, h, start)[::steps].T.copy()


def _one_by_one(rates: Rates, q: Array, qd: Array, h: float, start: Array) -> Array:
    """The states ((N + 1) x s), each step linearised where it begins: slow, and certain of an end. About a state of
    zero a power of it below one has no slope, and guesses of the whole course jump for ever.
    """
    z = np.empty((len(q) + 1, len(start)))
    z[0] = start
    for i in range(len(q)):
        rate, slope = _linearised(rates, q[i : i + 1], qd[i : i + 1], z[i : i + 1])
        z[i + 1] = z[i] + h * (phi(h * slope) * rate)[0]
    return z


def phi(x: Array) -> Array:
    """(e^x - 1)/x."""
    small = np.abs(x) < 1e-9
    return np.where(small, 1.0, np.expm1(x) / np.where(small, 1.0, x))


def _steps(rates: Rates, q: Array, qd: Array, period: float, states: int) -> int:
    """Steps a sample, for states of the order of one."""
    fastest = max(np.abs(_linearised(rates, q, qd, np.full((len(q), states), sign))[1]).max() for sign in (-1.0, 1.0))
    return int(np.clip(np.ceil(fastest * period / _DECAY), 1, _STEPS))


def _linearised(rates: Rates, q: Array, qd: Array, z: Array) -> tuple[Array, Array]:
    """Rates at the states and their slopes (N x s each); each rate is moved by its own state only."""
    above, below = rates(q, qd, z + _APART), rates(q, qd, z - _APART)
    return rates(q, qd, z), (above - below) / (2 * _APART)
