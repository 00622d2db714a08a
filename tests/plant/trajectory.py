"""References that a controller follows, sampled at its rate."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from tests.plant.robot import Robot

Array: TypeAlias = NDArray[np.float64]

#: Positions and speeds (T x n each) of a robot at times (T) [s].
Motion: TypeAlias = Callable[[Robot, Array], tuple[Array, Array]]


@dataclass(frozen=True)
class Trajectory:
    """``duration`` [s] is logged, after ``before`` [s] of the same motion that is not. ``period`` [s] is 0 without
    one.

    ``motion`` is asked for times from 0, the start of ``before``.
    """

    motion: Motion
    duration: float
    before: float
    period: float = 0.0

    def sample(self, robot: Robot, rate: float) -> tuple[Array, Array]:
        """Positions and speeds (T x n each) at ``rate`` [Hz], the last logged instant included."""
        ticks = round((self.before + self.duration) * rate) + 1
        q, qd = self.motion(robot, np.arange(ticks) / rate)
        return np.ascontiguousarray(q), np.ascontiguousarray(qd)


def limits(robot: Robot) -> tuple[Array, Array, Array, Array]:
    """Centre, half of the range, largest speed and acceleration (n each)."""
    low, high, speed, acceleration = np.array([joint.range for joint in robot.chain]).T
    centre = robot.centre
    return centre, np.minimum(centre - low, high - centre), speed, acceleration
