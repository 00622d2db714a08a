"""Between motors and joints: the matrix N, torque constants, and what one motor does to the joints that it drives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from generator.robot.description import Robot
from identification.arrays import Array

#: Motion [rad, m] beyond which a drive train does more than yield.
YIELDS = 0.05


def coupling(robot: Robot) -> Array:
    """N (n x n): motor speeds from joint speeds; one to one where the robot has no drives."""
    if robot.drives is None:
        return np.eye(len(robot.moving))
    return np.array([[float(entry) for entry in row] for row in robot.drives.coupling])


def constants(robot: Robot) -> Array:
    """Torque constants in use (n) [N m/A]; ones where the file tells none."""
    drives = robot.drives
    if drives is None or not drives.torque_constants:
        return np.ones(len(robot.moving))
    return np.array([float(kt) for kt in drives.torque_constants[drives.torque_constant]])


def stated_constants(robot: Robot) -> dict[int, float]:
    """Torque constants in use [N m/A] by the number of their motor's joint; none where the file tells none."""
    stated = robot.drives is not None and bool(robot.drives.torque_constants)
    return dict(zip(robot.numbers, constants(robot).tolist(), strict=True)) if stated else {}


def with_constants(robot: Robot, values: Sequence[float]) -> Robot:
    """The robot with these torque constants (n) [N m/A]; itself where it has no drives."""
    drives = robot.drives
    if drives is None:
        return robot
    named = {"given": tuple(map(Fraction, values))}
    return replace(robot, drives=replace(drives, torque_constants=named, torque_constant="given"))


def motor_torques(robot: Robot, tau: Array) -> Array:
    """Torques of the motors [N m] (n x N) from those of the joints (n x N): N^-T tau."""
    return np.asarray(np.linalg.solve(coupling(robot).T, tau), dtype=float)


def supplied(robot: Robot, motor: int, tau: Array) -> Array:
    """The part of joint torques (n x N) that motor number ``motor``, from 0, supplies: N^T E N^-T tau.

    E picks the motor.
    """
    return np.outer(coupling(robot)[motor], motor_torques(robot, tau)[motor])


def driven(robot: Robot, marked: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Samples (n x N) of joints in which a motor that drives them is ``marked`` (n x N)."""
    acts = (coupling(robot).T != 0).astype(int)
    return np.asarray(acts @ marked.astype(int) > 0)
