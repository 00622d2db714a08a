"""Torque constants of motors that press: what their currents do beside overcoming their own dry friction (eq. 75, 78).

A motor that stands may hold any torque within its friction, so only samples count in which it turns:
i = (tau + Fc s) / kt + c, s the direction in which it turns, c what weight and preload ask in a pose.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from identification.colour import inflation
from identification.residuals import Residual

Array = NDArray[np.float64]

#: Fewest samples an unknown.
_FEWEST = 3
#: Part of the torques that friction and preload must not be able to stand for.
_SEEN = 1e-3


@dataclass(frozen=True)
class Turning:
    """Samples of one motor in one pose in which it turns (N each): current ``i`` [A], torque ``tau`` that the force and
    the rotor ask of it [N m], both on the motor side, and ``direction`` (1 or -1).
    """

    i: Array
    tau: Array
    direction: Array


def torque_constant(poses: Sequence[Turning]) -> tuple[float, float, Residual]:
    """kt [N m/A] with its standard deviation for residuals coloured as found, and what is left of the torques.

    Raises ValueError, with the reason, where friction and preload cannot be told from the force.
    """
    tau, direction, i = (np.concatenate([getattr(one, name) for one in poses]) for name in ("tau", "direction", "i"))
    preload = np.repeat(np.eye(len(poses)), [len(one.i) for one in poses], axis=0)
    others = np.column_stack([direction, preload[:, preload.any(axis=0)]])
    if len(i) < _FEWEST * (1 + others.shape[1]):
        raise ValueError("the motor hardly turns between the steps")
    own = tau - others @ np.linalg.lstsq(others, tau, rcond=None)[0]
    power = float(own @ own)
    if power <= (_SEEN * np.linalg.norm(tau)) ** 2:
        raise ValueError("its friction cannot be told from the force: steps up and down are needed")
    slope = float(own @ i) / power
    left = i - slope * own
    error = left - others @ np.linalg.lstsq(others, left, rcond=None)[0]
    variance = float(error @ error) / (len(i) - 1 - others.shape[1]) * inflation(error)
    kt = 1 / slope if slope else np.inf
    std = float(np.sqrt(variance / power)) * kt**2
    about = kt * (i - preload @ np.linalg.lstsq(preload, i, rcond=None)[0])
    size = float(np.linalg.norm(about))
    return kt, std, Residual(len(i), float(np.linalg.norm(kt * error)), size, size)
