"""Finite Fourier series: identical periods whose harmonics are exact."""

from __future__ import annotations

import numpy as np

from tests.plant.robot import Robot
from tests.plant.trajectory import Array, Trajectory, limits


def fourier(
    seed: int,
    period: float = 10.0,
    periods: int = 4,
    harmonics: int = 6,
    share: float = 0.7,
    before: float | None = None,
) -> Trajectory:
    """Random series about the robot's centre, each joint scaled until one limit of range, speed or acceleration is
    met to ``share``.

    ``period`` [s] must hold a whole number of logged samples. One period is played before the log begins, or
    ``before`` [s].
    """

    def motion(robot: Robot, t: Array) -> tuple[Array, Array]:
        rng = np.random.default_rng([seed, 1])
        centre, half, speed, acceleration = limits(robot)
        k = np.arange(1, harmonics + 1)
        a, b = rng.normal(size=(2, robot.joints, harmonics)) / k
        w = 2 * np.pi / period * k

        def at(times: Array) -> tuple[Array, Array, Array]:
            c, s = np.cos(np.outer(times, w)), np.sin(np.outer(times, w))
            return _sum(c, a) + _sum(s, b), _sum(c * w, b) - _sum(s * w, a), -_sum(c * w**2, a) - _sum(s * w**2, b)

        fine = at(np.linspace(0, period, 200 * harmonics, endpoint=False))
        peaks = [np.max(np.abs(x), axis=0) for x in fine]
        scale = share * np.min([half / peaks[0], speed / peaks[1], acceleration / peaks[2]], axis=0)
        rows = round(period / (t[1] - t[0]))
        q, qd, _ = at(t[:rows])
        again = np.arange(len(t)) % rows
        return (centre + scale * q)[again], (scale * qd)[again]

    return Trajectory(motion, period * periods, period if before is None else before, period)


def _sum(waves: Array, weights: Array) -> Array:
    # Not the product of matrices, whose threads cost more than they save and need not add in the same order everywhere.
    return np.asarray(np.einsum("tk,jk->tj", waves, weights))
