"""What currents do, whatever the torque constants are: the matrix N, and a robot whose torques are N^T i."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from generator.errors import InputError
from generator.robot.description import Drives, Robot

Array = NDArray[np.float64]


def coupling(robot: Robot) -> Array:
    """N (n x n): motor speeds from joint speeds; raises InputError for a robot without drives."""
    if robot.drives is None:
        raise InputError(robot.place, f"{robot.name} has no drives", "gear ratios, to know what currents do")
    return np.array([[float(entry) for entry in row] for row in robot.drives.coupling])


def with_unit_constants(robot: Robot) -> Robot:
    """The robot with torque constants of 1 N m/A, for which the joint torques of currents are N^T i."""
    drives = robot.drives
    if drives is None:
        return robot
    unit = tuple(Fraction(1) for _ in drives.coupling)
    return replace(robot, drives=Drives(drives.ratios, drives.coupling, {"unit": unit}, "unit"))


def supplied(robot: Robot, motor: int, tau: Array) -> Array:
    """The part of joint torques (n x N) that motor number ``motor``, from 0, supplies: N^T E N^-T tau.

    E picks the motor. Without drives each joint has its own motor.
    """
    if robot.drives is None:
        result = np.zeros_like(tau)
        result[motor] = tau[motor]
        return result
    N = coupling(robot)
    return np.outer(N[motor], np.linalg.solve(N.T, tau)[motor])
