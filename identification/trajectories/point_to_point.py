"""Moves from point to point, all joints at once, with rests between them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from identification.arrays import Array
from identification.trajectory import Reference, Setting, Task, Trajectory

#: Way and speed (m each) of a move over 0 to 1 at times [s], from the largest rate [1/s] and its growth [1/s2].
Profile = Callable[[float, float], tuple[float, Callable[[Array], tuple[Array, Array]]]]


def _trapezoidal(rate: float, growth: float) -> tuple[float, Callable[[Array], tuple[Array, Array]]]:
    """Even growth of the speed, even speed, even fall; the duration [s] and the profile."""
    rate = min(rate, np.sqrt(growth))
    rise = rate / growth
    duration = 1 / rate + rise

    def profile(t: Array) -> tuple[Array, Array]:
        speed = np.clip(np.minimum(growth * t, growth * (duration - t)), 0.0, rate)
        before, after = np.clip(t, 0.0, rise), np.clip(t - duration + rise, 0.0, rise)
        way = growth * before**2 / 2 + rate * np.clip(t - rise, 0.0, duration - 2 * rise)
        return way + rate * after - growth * after**2 / 2, speed

    return duration, profile


def _smooth(rate: float, growth: float) -> tuple[float, Callable[[Array], tuple[Array, Array]]]:
    """The polynomial of order 5 from rest to rest; its peaks are 15/8 of the mean speed and 10/sqrt(3) / duration^2."""
    duration = max(15 / 8 / rate, np.sqrt(10 / np.sqrt(3) / growth))

    def profile(t: Array) -> tuple[Array, Array]:
        s = np.clip(t / duration, 0.0, 1.0)
        return s**3 * (10 - 15 * s + 6 * s**2), 30 * s**2 * (1 - s) ** 2 / duration

    return duration, profile


_PROFILES: dict[str, Profile] = {"smooth": _smooth, "trapezoidal": _trapezoidal}


def _plan(task: Task) -> Reference:
    """Points are drawn within the room of each joint; the joint that needs longest sets the time of a move."""
    profile = _PROFILES[str(task.settings["profile"])]
    lower, upper = task.room
    q = np.tile(task.pose, (task.samples, 1))
    qd = np.zeros_like(q)
    start, at = task.number("pause"), task.pose
    while start < task.samples * task.period:
        way = task.draw.uniform(lower, upper) - at
        longest = np.abs(way).max()
        duration, move = profile(task.number("speed") / longest, task.number("acceleration") / longest)
        part, speed = move(task.times - start)
        q += np.outer(part, way)
        qd += np.outer(speed, way)
        at, start = at + way, start + duration + task.number("pause")
    return Reference(q, qd)


TRAJECTORY = Trajectory(
    name="point_to_point",
    title="moves between points drawn within the limits, from the pose on",
    settings={
        "profile": Setting("smooth", "of the speed", choices=tuple(sorted(_PROFILES))),
        "speed": Setting(1.0, "largest speed of a joint [rad/s, m/s]"),
        "acceleration": Setting(2.0, "largest acceleration of a joint [rad/s2, m/s2]"),
        "pause": Setting(0.5, "rest before each move [s]"),
    },
    plan=_plan,
)
