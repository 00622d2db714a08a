"""How well a motion shows the base parameters, for many motions at once.

The information on them is sum over joints of W_j^T W_j / sigma_j^2, without the rows that identify leaves out near
standstill. Columns that depend on each other whatever the motion, so that no run tells them apart, do not count.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.excitation.limits import Limits
from identification.excitation.memory import Memory
from identification.excitation.noise import Noise
from identification.excitation.shapes import SEARCHED
from identification.observation import Motion, Regressors, standing

#: Criteria by name: mean of the logarithms of the singular values of W, its condition number.
DETERMINANT, CONDITION = "determinant", "condition"
#: Eigenvalues of the information below this part of the largest count as zero, as does a share of a torque limit.
_ZERO = 1e-11
#: Cost of torques beyond their limits, per square of the part beyond.
_BEYOND = 100.0


@dataclass(frozen=True)
class Criterion:
    """What is judged: a motion of the robot of ``memory``, with the parameters that torques are computed with.

    ``standstill`` (n) [rad/s, m/s] and ``factor`` are those of the identification.
    """

    memory: Memory
    limits: Limits
    noise: Noise
    standstill: Array
    factor: int
    kind: str = DETERMINANT

    @property
    def regressors(self) -> Regressors:
        """Those of the robot."""
        return self.memory.regressors

    def information(self, motions: Motion, count: int) -> tuple[Array, Array]:
        """Of ``count`` motions of ``Shapes`` one after the other: information (count x p x p), largest load (count)."""
        motions = self.memory.runs(motions, count)
        names = self.regressors.names
        place = {name: k for k, name in enumerate(names)}
        columns = self.regressors.base(motions)
        left_out = standing(self.regressors.signs, motions.qd, self.standstill)
        tau = np.stack(
            [
                np.array([self.memory.values[name] for name in row]) @ W
                for row, W in zip(self.regressors.structure, columns, strict=True)
            ]
        )
        samples = motions.samples // count
        sigma = np.maximum(self.noise.deviations(self.factor), np.finfo(float).tiny)
        result = np.zeros((count, len(names), len(names)))
        for k, (row, W) in enumerate(zip(self.regressors.structure, columns, strict=True)):
            # In blocks so small that the matrix product does not start threads, which cost more than they bring.
            used = np.where(left_out[k], 0.0, W / sigma[k]).reshape(len(row), count, -1, SEARCHED)
            blocks = used.transpose(1, 2, 0, 3)
            at = [place[name] for name in row]
            result[np.ix_(range(count), at, at)] += (blocks @ blocks.transpose(0, 1, 3, 2)).sum(axis=1) / samples
        loads = np.abs(self.limits.loads @ tau).reshape(-1, count, samples).max(axis=(0, 2), initial=0.0)
        return result, loads

    def costs(self, information: Array, loads: Array, scale: Array, rank: int) -> Array:
        """Of each motion (B), the smaller the better; ``scale`` (p) are sizes of the columns, ``rank`` of W."""
        if self.kind == CONDITION:
            scale = _sizes(information)
        eigenvalues = _eigenvalues(information, scale)[:, -rank:]
        seen = np.log(np.maximum(eigenvalues, _ZERO * eigenvalues[:, -1:]))
        cost = (seen[:, -1] - seen[:, 0]) / 2 if self.kind == CONDITION else -seen.mean(axis=1) / 2
        result: Array = cost + _BEYOND * np.maximum(loads - 1, 0.0) ** 2
        return result


def sizes_and_rank(information: Array) -> tuple[Array, int]:
    """Typical sizes of the columns (p), and the largest rank among motions (B x p x p)."""
    scale = np.sqrt((_sizes(information) ** 2).mean(axis=0))
    scale[scale == 0] = 1.0
    eigenvalues = _eigenvalues(information, scale)
    return scale, int((eigenvalues > _ZERO * np.maximum(eigenvalues[:, -1:], np.finfo(float).tiny)).sum(axis=1).max())


def _sizes(information: Array) -> Array:
    """Lengths of the columns of W (B x p), 1 for those that are zero."""
    squares = np.diagonal(information, axis1=1, axis2=2)
    result: Array = np.sqrt(np.where(squares > 0, squares, 1.0))
    return result


def _eigenvalues(information: Array, scale: Array) -> Array:
    """In rising order (B x p), with columns in units of ``scale`` (p, or B x p)."""
    return np.asarray(np.linalg.eigvalsh(information / scale[..., :, None] / scale[..., None, :]), dtype=float)
