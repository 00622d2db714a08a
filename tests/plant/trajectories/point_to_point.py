"""Moves between random points, all joints at once, with a rest at each."""

from __future__ import annotations

import numpy as np

from tests.plant.robot import Robot
from tests.plant.trajectory import Array, Trajectory, limits


def point_to_point(
    seed: int, duration: float = 40.0, smooth: bool = False, share: float = 0.7, rest: float = 0.3
) -> Trajectory:
    """Trapezoids of speed, or where ``smooth`` polynomials of degree five, within ``share`` of the limits; two
    seconds of rest are played before the log begins.
    """

    def motion(robot: Robot, t: Array) -> tuple[Array, Array]:
        rng = np.random.default_rng([seed, 2])
        centre, half, speed, acceleration = limits(robot)
        q, qd = np.tile(centre, (len(t), 1)), np.zeros((len(t), robot.joints))
        now, here = 2.0, centre
        while now < t[-1]:
            there = centre + share * half * rng.uniform(-1, 1, robot.joints)
            way = there - here
            needed = _quintic_time if smooth else _trapezoid_time
            last = float(np.max(needed(np.abs(way), share * speed, share * acceleration)))
            ramp = float(np.max(speed / acceleration))
            inside = (t >= now) & (t < now + last)
            along, rate = _quintic(t[inside] - now, last) if smooth else _trapezoid(t[inside] - now, last, ramp)
            q[inside], qd[inside] = here + np.outer(along, way), np.outer(rate, way)
            q[t >= now + last] = there
            now, here = now + last + rest, there
        return q, qd

    return Trajectory(motion, duration, 2.0)


def _quintic_time(way: Array, speed: Array, acceleration: Array) -> Array:
    return np.asarray(np.maximum(1.875 * way / speed, np.sqrt(5.7736 * way / acceleration)))


def _quintic(t: Array, last: float) -> tuple[Array, Array]:
    x = t / last
    return x**3 * (10 - 15 * x + 6 * x**2), 30 * x**2 * (1 - x) ** 2 / last


def _trapezoid_time(way: Array, speed: Array, acceleration: Array) -> Array:
    # Ramps as long as the slowest joint's; the largest speed is way / (last - ramp), reached in one ramp.
    ramp = float(np.max(speed / acceleration))
    return np.asarray(np.maximum(ramp + np.maximum(way / speed, way / (acceleration * ramp)), 2 * ramp))


def _trapezoid(t: Array, last: float, ramp: float) -> tuple[Array, Array]:
    top = 1 / (last - ramp)
    up, down = np.minimum(t, ramp), np.maximum(t - (last - ramp), 0.0)
    along = top * (up**2 / (2 * ramp) + np.maximum(t - ramp, 0.0) - down**2 / (2 * ramp))
    return along, top * (np.minimum(t, ramp) - down) / ramp
