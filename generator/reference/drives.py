"""The drive train: motor side and joint side of positions, speeds and torques (report eq. 14-18).

q_r = N q for positions and speeds, tau = N^T tau_r by equal power, tau_r = diag(kt) I.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from generator.reference.arithmetic import Array, decimals, exact, solve
from generator.robot.description import Drives, Robot


@dataclass(frozen=True)
class DriveTrain:
    """``N`` (n x n), row i the motor i, column j the joint j; torque constants ``kt`` [N m/A] (n) or None."""

    N: Array
    kt: Array | None

    def to_motor(self, joint: Array) -> Array:
        """Motor positions [rad] or speeds [rad/s] (n)."""
        return self.N @ joint

    def to_joint(self, motor: Array) -> Array:
        """Joint positions or speeds (n)."""
        return solve(self.N, motor)

    def motor_torque(self, tau: Array) -> Array:
        """Motor torques [N m] (n) that give the joint torques ``tau``."""
        return solve(self.N.T, tau)

    def joint_torque(self, motor: Array) -> Array:
        """Joint torques (n) that the motor torques give."""
        return self.N.T @ motor

    def current(self, tau: Array) -> Array:
        """Motor currents [A] (n) that give the joint torques ``tau``."""
        return self.motor_torque(tau) / self.constants

    def torque_from_current(self, current: Array) -> Array:
        """Joint torques (n) that the motor currents [A] give."""
        return self.joint_torque(self.constants * current)

    @property
    def constants(self) -> Array:
        """kt; raises ValueError where the robot's file gives none."""
        if self.kt is None:
            raise ValueError("the drives have no torque constants")
        return self.kt


def drive_train(robot: Robot, values: Mapping[str, float], warmth: Array) -> DriveTrain:
    """The drives of ``robot``; a torque constant is taken from ``values`` as ``kt<joint>`` if it is there.

    The constants are those at the ``warmth`` of the drives (n).
    """
    if robot.drives is None:
        raise ValueError("the robot has no drives")
    N = decimals([[exact(entry) for entry in row] for row in robot.drives.coupling])
    nominal = _nominal(robot.drives)
    if nominal is None:
        return DriveTrain(N, None)
    given = {joint.number: values.get(f"kt{joint.number}") for joint in robot.moving}
    kt = [default if (value := given[j]) is None else value for j, default in zip(given, nominal, strict=True)]
    drift = [_quotient(part) for part in robot.drives.torque_drift] or [0] * len(kt)
    return DriveTrain(N, decimals(kt) * (1 + np.array(drift, dtype=object) * warmth))


def _nominal(drives: Drives) -> Array | None:
    if not drives.torque_constants:
        return None
    return np.array([_quotient(kt) for kt in drives.torque_constants[drives.torque_constant]], dtype=object)


def _quotient(fraction: Fraction) -> object:
    return decimals(fraction.numerator) / decimals(fraction.denominator)
