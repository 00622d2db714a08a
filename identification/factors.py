"""Observation matrices as triangular factors: all that least squares needs of any number of rows.

For a joint's rows [W Y] = Q [R z], the factor holds [R z]: norms, residuals and solutions of the rows are those of the
factor. Factors add up row by row, so memory does not grow with the number of samples.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.sampling import Rows

#: Rows that are collected before they are reduced, in multiples of the columns.
_COLLECTED = 20


@dataclass(frozen=True)
class Factor:
    """Rows of one joint: ``R`` (at most p + 1 rows x p + 1 columns, the last one Y) for the parameters ``names`` (p).

    ``rows`` is their number, ``total`` the sum of Y over them [N m, N].
    """

    joint: int
    names: tuple[str, ...]
    R: Array
    rows: int
    total: float

    def on(self, names: Sequence[str]) -> Array:
        """R with the columns of k ``names`` and Y (rows x (k + 1)), zero columns for parameters that it lacks."""
        result = np.zeros((len(self.R), len(names) + 1))
        place = {name: k for k, name in enumerate(self.names)}
        for k, name in enumerate(names):
            if name in place:
                result[:, k] = self.R[:, place[name]]
        result[:, -1] = self.R[:, -1]
        return result

    def residual(self, values: Mapping[str, float]) -> float:
        """||Y - W chi|| for values of all its parameters."""
        chi = np.array([values[name] for name in self.names])
        return float(np.linalg.norm(self.R[:, -1] - self.R[:, :-1] @ chi))

    def with_torques(self, values: Mapping[str, float]) -> Factor:
        """The factor of the same rows with Y = W chi for ``values``; the sum of Y is lost."""
        W = self.R[:, :-1]
        Y = W @ np.array([values[name] for name in self.names])
        return Factor(self.joint, self.names, np.column_stack([W, Y]), self.rows, 0.0)

    @property
    def norm(self) -> float:
        """||Y||."""
        return float(np.linalg.norm(self.R[:, -1]))

    @property
    def spread(self) -> float:
        """||Y - mean(Y)||."""
        return float(np.sqrt(max(self.norm**2 - self.total**2 / max(self.rows, 1), 0.0)))


def factors(parts: Iterable[Rows]) -> tuple[Factor, ...]:
    """One factor a joint of all rows, in the order of the joints."""
    growing: dict[int, _Growing] = {}
    for part in parts:
        growing.setdefault(part.joint, _Growing(part.joint, part.names)).add(part)
    return tuple(growing[joint].factor() for joint in sorted(growing))


def added(some: Sequence[Factor], names: tuple[str, ...] | None = None) -> tuple[Factor, ...]:
    """The factors of all rows that ``some`` were made of, one a joint, with all their parameters."""
    result = []
    for joint in sorted({one.joint for one in some}):
        mine = [one for one in some if one.joint == joint]
        union = names or tuple(dict.fromkeys(name for one in mine for name in one.names))
        R = triangular(np.concatenate([one.on(union) for one in mine]))
        result.append(Factor(joint, union, R, sum(one.rows for one in mine), sum(one.total for one in mine)))
    return tuple(result)


def triangular(matrix: Array) -> Array:
    """R (n x n) of the QR factorisation of a matrix (m x n), the matrix itself where m <= n."""
    if len(matrix) <= matrix.shape[1]:
        return matrix
    return np.asarray(np.linalg.qr(matrix, mode="r"), dtype=float)


class _Growing:
    """Rows of one joint as they come."""

    def __init__(self, joint: int, names: tuple[str, ...]) -> None:
        self._joint, self._names = joint, names
        self._waiting: list[Array] = []
        self._rows, self._total = 0, 0.0

    def add(self, part: Rows) -> None:
        self._waiting.append(np.column_stack([part.W, part.Y]))
        self._rows += len(part.Y)
        self._total += float(part.Y.sum())
        if sum(map(len, self._waiting)) > _COLLECTED * (len(self._names) + 1):
            self._waiting = [triangular(np.concatenate(self._waiting))]

    def factor(self) -> Factor:
        R = triangular(np.concatenate(self._waiting))
        return Factor(self._joint, self._names, R, self._rows, self._total)
