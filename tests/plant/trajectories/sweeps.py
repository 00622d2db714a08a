"""Back and forth: at constant speeds for friction's curve, and slowly for what reversals show."""

from __future__ import annotations

import numpy as np

from tests.plant.robot import Robot
from tests.plant.trajectory import Array, Trajectory, limits


def speed_sweeps(
    joint: int, levels: tuple[float, ...] = (0.05, 0.1, 0.2, 0.4, 0.7), share: float = 0.6, duration: float = 40.0
) -> Trajectory:
    """One joint (from 1) back and forth at constant speeds, ``levels`` of its largest, within ``share`` of its range;
    the others rest.
    """

    def motion(robot: Robot, t: Array) -> tuple[Array, Array]:
        centre, half, speed, acceleration = limits(robot)
        j = joint - 1
        q, qd = np.tile(centre, (len(t), 1)), np.zeros((len(t), robot.joints))
        qd[:, j] = _back_and_forth(t, levels, share * half[j], speed[j], share * acceleration[j])
        q[1:, j] += np.cumsum(0.5 * (qd[1:, j] + qd[:-1, j]) * np.diff(t))
        return q, qd

    return Trajectory(motion, duration, 1.0)


def _back_and_forth(t: Array, levels: tuple[float, ...], half: float, speed: float, acceleration: float) -> Array:
    """Speeds (T) of there and back, for each level as often as it fits; ways are cut to a second and a half where it
    is slow.
    """
    result = np.zeros(len(t))
    now, k = 1.0, 0
    while now < t[-1]:
        top = min(levels[k % len(levels)] * speed, float(np.sqrt(acceleration * half)))
        ramp = top / acceleration
        hold = min(half / top - ramp, 1.5)
        for sign in (1.0, -1.0):
            x = t - now
            result += sign * top * np.clip(np.minimum(x, 2 * ramp + hold - x) / ramp, 0.0, 1.0)
            now += 2 * ramp + hold
        k += 1
    return result


def slow_reversals(seed: int, period: float = 10.0, periods: int = 4, share: float = 0.03) -> Trajectory:
    """All joints in slow oscillation of a few harmonics, ``share`` of the range, so that they reverse often at low
    speed.
    """

    def motion(robot: Robot, t: Array) -> tuple[Array, Array]:
        rng = np.random.default_rng([seed, 3])
        centre, half, speed, _ = limits(robot)
        orders = rng.integers(2, 6, size=(robot.joints, 2))
        phases = rng.uniform(0, 2 * np.pi, size=(robot.joints, 2))
        w = 2 * np.pi / period * orders
        scale = np.minimum(share * half, 0.1 * speed / np.sum(w, axis=1))[:, None]
        angle = np.mod(t, period)[:, None, None] * w + phases
        return centre + np.sum(scale * np.sin(angle), axis=2), np.sum(scale * w * np.cos(angle), axis=2)

    return Trajectory(motion, period * periods, period, period)
