"""What the measured torques will be off by: noise of the logged efforts, and what no model explains."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from generator.robot.description import Robot
from identification.arrays import Array
from identification.drive_train import constants, coupling

#: Part of usual torques that is taken where no noise is given.
PART = 0.02


@dataclass(frozen=True)
class Noise:
    """Of each joint's torque [N m, N] (n each): rms of white noise in every ``sampled`` value, and of what is left.

    ``remaining`` is an error of the decimated torques, as friction leaves it that is not what the model says.
    """

    sampled: Array
    remaining: Array

    def deviations(self, factor: int) -> Array:
        """Standard deviations (n) [N m, N] of the residuals of rows decimated by ``factor``.

        The decimation passes a band of white noise in which its density is that of noise 1/sqrt(factor) as large: that
        is what the columns, which pass the same filter, meet.
        """
        result: Array = np.sqrt(self.sampled**2 / factor + self.remaining**2)
        return result


def noise_of(robot: Robot, logged: Sequence[float], part: float, torques: Array) -> Noise:
    """From the ``logged`` rms of each motor's effort: A with torque constants, else N m, N; of joints without drives.

    Joint torques are N^T kt i; the motors' noises are independent. What remains is a ``part`` of the rms ``torques``
    (n) [N m, N] of usual motions.
    """
    n = len(robot.moving)
    rms = np.array(np.broadcast_to(np.asarray(logged, dtype=float), (n,)))
    if robot.drives is not None:
        rms = np.sqrt((coupling(robot).T ** 2) @ (constants(robot) * rms) ** 2)
    return Noise(rms, part * torques)
