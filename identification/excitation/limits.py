"""What a designed motion must not exceed: positions, speeds, accelerations, torques of joints and of motors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from generator.robot.description import Joint, Robot
from identification.arrays import Array
from identification.drive_train import constants, coupling
from identification.trajectory import room

#: Of joints whose file has none [rad/s, m/s; rad/s2, m/s2].
SPEED, ACCELERATION = 1.0, 2.0


@dataclass(frozen=True)
class Limits:
    """``lower`` and ``upper`` positions, ``speed`` and ``acceleration`` (n each) [rad, m; s].

    Torques tau (n) [N m, N] are allowed where |``loads`` tau| <= 1 in every row; there are no rows without limits.
    """

    lower: Array
    upper: Array
    speed: Array
    acceleration: Array
    loads: Array


def limits_of(robot: Robot, speed: float | None = None, acceleration: float | None = None) -> Limits:
    """The limits in a robot file; ``speed`` and ``acceleration`` hold as well where they are given, for all joints.

    Torques are limited by joints' ``torque_limit`` and by the currents of ``signals: current_limit``.
    """
    lower, upper = room(robot)
    joints = robot.moving
    speeds = [_least(joint.speed_limit, speed, SPEED) for joint in joints]
    accelerations = [_least(joint.acceleration_limit, acceleration, ACCELERATION) for joint in joints]
    rows = [*_joint_loads(joints), *_motor_loads(robot)]
    return Limits(lower, upper, np.array(speeds), np.array(accelerations), np.reshape(rows, (-1, len(joints))))


def _least(own: object, given: float | None, default: float) -> float:
    known = [float(one) for one in (own, given) if one is not None]  # type: ignore[arg-type]
    return min(known, default=default)


def _joint_loads(joints: tuple[Joint, ...]) -> list[Array]:
    unit = np.eye(len(joints))
    return [unit[k] / float(joint.torque_limit) for k, joint in enumerate(joints) if joint.torque_limit is not None]


def _motor_loads(robot: Robot) -> list[Array]:
    """Motor torques are N^-T tau (report eq. 18), their limits kt i."""
    drives, currents = robot.drives, robot.signals.current_limit
    if drives is None or not currents or not drives.torque_constants:
        return []
    largest = constants(robot) * np.array([float(current) for current in currents])
    return list(np.linalg.inv(coupling(robot)).T / largest[:, None])
