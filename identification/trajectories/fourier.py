"""Finite Fourier series (Swevers et al. 1997): periodic, from rest to rest, within limits."""

from __future__ import annotations

import numpy as np

from identification.trajectory import Array, Reference, Setting, Task, Trajectory

#: Instants of a period at which a series is looked at.
_LOOKED_AT = 2000
#: Largest phase of the highest harmonic in a sample [rad].
_PHASE = 0.5


def _plan(task: Task) -> Reference:
    """q = c + sum over l of a_l sin(l w t) + b_l cos(l w t), as large as the tightest of the limits allows."""
    w = 2 * np.pi * task.number("frequency")
    orders = np.arange(1.0, round(task.number("harmonics")) + 1)
    if w * orders[-1] * task.period > _PHASE:
        raise ValueError("the highest harmonic is too fast for the controller, expected a lower frequency")
    lower, upper = task.room
    n = len(task.pose)
    q, qd = np.empty((task.samples, n)), np.empty((task.samples, n))
    phases = np.outer(w * task.times, orders)
    looked_at = np.outer(np.linspace(0, 2 * np.pi, _LOOKED_AT), orders)
    for k in range(n):
        # Speed and acceleration are zero at t = 0: sum a_l l = 0 and sum b_l l^2 = 0.
        a, b = (_without(task.draw.normal(size=len(orders)) / orders, orders**power) for power in (1, 2))
        room = min(upper[k] - task.pose[k], task.pose[k] - lower[k])
        if room <= 0:
            number = task.robot.moving[k].number
            raise ValueError(f"joint {number} is too near to its limit, expected --pose with room on both sides")
        limits = (room, task.number("speed"), task.number("acceleration"))
        peaks = [np.abs(one).max() for one in _motion(a, b, orders, w, looked_at)]
        scale = min(limit / peak for limit, peak in zip(limits, peaks, strict=True))
        motion = _motion(scale * a, scale * b, orders, w, phases)
        q[:, k], qd[:, k] = task.pose[k] + motion[0], motion[1]
    return Reference(q, qd)


def _without(x: Array, direction: Array) -> Array:
    """``x`` without its part along ``direction``."""
    result: Array = x - direction * (x @ direction) / (direction @ direction)
    return result


def _motion(a: Array, b: Array, orders: Array, w: float, phases: Array) -> tuple[Array, Array, Array]:
    """Position, speed, acceleration at phases l w t (N x orders)."""
    sine, cosine = np.sin(phases), np.cos(phases)
    rate = w * orders
    return (
        sine @ a + cosine @ b,
        cosine @ (rate * a) - sine @ (rate * b),
        -sine @ (rate**2 * a) - cosine @ (rate**2 * b),
    )


TRAJECTORY = Trajectory(
    name="fourier",
    title="Fourier series about the pose, from rest to rest",
    settings={
        "frequency": Setting(0.1, "lowest frequency [Hz]"),
        "harmonics": Setting(5.0, "number of its multiples", above=1, below=100, whole=True),
        "speed": Setting(1.0, "largest speed of a joint [rad/s, m/s]"),
        "acceleration": Setting(2.0, "largest acceleration of a joint [rad/s2, m/s2]"),
    },
    plan=_plan,
)
