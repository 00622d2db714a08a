"""Rows of the inverse model on the motor side, where each row holds the current of one motor alone.

Joint torques are N^T kt i (report eq. 18, 49), so that N^-T times the joints' rows gives kt_m i_m = B_m chi for motor
m: the same equations as report eq. 51, with the coupling moved to the model's side, where nothing is noisy.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.observation import Regressors
from identification.sampling import Rows, Sampled, rows_of


@dataclass(frozen=True)
class MotorRows:
    """Rows of motor ``motor`` (from 0) in time order: ``B`` (rows x p) [N m on the motor side per unit of a parameter],
    ``i`` (rows) [A], times ``t`` (rows) [s].
    """

    motor: int
    B: Array
    i: Array
    t: Array


def motor_rows(sampled: Sampled, regressors: Regressors, N: Array, names: Sequence[str]) -> list[MotorRows]:
    """The rows of a run whose efforts are N^T i, for the parameters ``names`` (p).

    N (n x n) maps joint to motor speeds. A motor has a row where all joints that its torque depends on have one.
    """
    joints = _joined(rows_of(sampled, regressors), len(N), names)
    times = np.unique(np.concatenate([one.t for one in joints]))
    W = np.full((len(N), len(times), len(names)), np.nan)
    Y = np.full((len(N), len(times)), np.nan)
    for k, one in enumerate(joints):
        at = np.searchsorted(times, one.t)
        W[k, at], Y[k, at] = one.W, one.Y
    result = []
    for m, row in enumerate(np.linalg.inv(N).T):
        needed = np.flatnonzero(np.abs(row) > 1e-12 * np.abs(row).max())
        B = np.tensordot(row[needed], W[needed], axes=1)
        i = row[needed] @ Y[needed]
        valid = np.isfinite(i)
        result.append(MotorRows(m, B[valid], i[valid], times[valid]))
    return result


@dataclass(frozen=True)
class _Joint:
    W: Array
    Y: Array
    t: Array


def _joined(parts: Iterable[Rows], count: int, names: Sequence[str]) -> list[_Joint]:
    """All rows of each joint, with a column for every name."""
    place = {name: k for k, name in enumerate(names)}
    found: list[list[Rows]] = [[] for _ in range(count)]
    for part in parts:
        found[part.joint].append(part)
    result = []
    for mine in found:
        W = np.zeros((sum(len(part.Y) for part in mine), len(names)))
        for c, name in enumerate(mine[0].names):
            W[:, place[name]] = np.concatenate([part.W[:, c] for part in mine])
        Y, t = (np.concatenate([getattr(part, what) for part in mine]) for what in ("Y", "t"))
        result.append(_Joint(W, Y, t))
    return result
