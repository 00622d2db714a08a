"""Least squares on triangular factors: solution, rank, and what cannot be seen (report eq. 40-45)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from identification.factors import Factor, triangular

Array = NDArray[np.float64]

#: Singular values of the scaled matrix below this part of the largest are zero.
_RANK = 1e-8
#: Part of a parameter in a direction that no row shows, from which it is not identifiable.
_INVOLVED = 1e-4


@dataclass(frozen=True)
class Solution:
    """Parameters by name, their order in ``covariance`` (p x p), and the ``hidden`` ones.

    ``values`` hold the fixed parameters too. Hidden ones have a value that only serves to estimate torques; their
    variance is infinite. ``sigma`` is the residual's standard deviation by joint [N m, N], ``condition`` that of W, of W
    with columns of unit length, and ``rank`` the number of independent columns.
    """

    names: tuple[str, ...]
    values: Mapping[str, float]
    covariance: Array
    hidden: tuple[str, ...]
    sigma: Mapping[int, float]
    condition: float
    scaled_condition: float
    rank: int

    def std(self, name: str) -> float:
        """Standard deviation of a parameter; infinite if it is hidden, zero if it was fixed."""
        if name in self.hidden:
            return float("inf")
        if name not in self.names:
            return 0.0
        k = self.names.index(name)
        return float(np.sqrt(self.covariance[k, k]))

    def relative_std(self, name: str) -> float:
        """Standard deviation in % of the value (report eq. 45)."""
        std, value = self.std(name), abs(self.values[name])
        if std == 0:
            return 0.0
        return 100 * std / value if value else float("inf")


@dataclass(frozen=True)
class Problem:
    """Factors of all joints, the parameters to estimate and those with given values; ``freedom`` as in a recipe."""

    factors: tuple[Factor, ...]
    names: tuple[str, ...]
    fixed: Mapping[str, float]
    weighted: bool
    by_samples: bool = False

    def without(self, name: str) -> Problem:
        """The same with one parameter zero."""
        names = tuple(one for one in self.names if one != name)
        return Problem(self.factors, names, {**self.fixed, name: 0.0}, self.weighted, self.by_samples)

    def solve(self) -> Solution:
        """Ordinary least squares, or weighted by each joint's own residual (report eq. 39-45)."""
        stacked = {one.joint: self._reduced(one) for one in self.factors}
        ordinary = _Solved.of(np.concatenate(list(stacked.values())))
        sigma = self._sigma(ordinary.chi, stacked)
        if not self.weighted:
            return self._solution(ordinary, sigma, self._common(sigma), ordinary)
        weighted = _Solved.of(np.concatenate([R / sigma[joint] for joint, R in stacked.items()]))
        sigma = self._sigma(weighted.chi, stacked)
        weighted = _Solved.of(np.concatenate([R / sigma[joint] for joint, R in stacked.items()]))
        return self._solution(weighted, self._sigma(weighted.chi, stacked), 1.0, ordinary)

    def _reduced(self, one: Factor) -> Array:
        """[R z] of the free parameters, the fixed ones' part taken from z."""
        R = one.on(self.names)
        given = np.array([self.fixed.get(name, 0.0) for name in one.names])
        R[:, -1] -= one.R[:, :-1] @ given
        return R

    def _sigma(self, chi: Array, stacked: Mapping[int, Array]) -> dict[int, float]:
        """Standard deviation of each joint's residual: ||e_j||^2 / (r_j - b_j), b_j the rank of its rows."""
        result = {}
        floor = max((one.norm / np.sqrt(max(one.rows, 1)) for one in self.factors), default=1.0) * 1e-12
        for one in self.factors:
            R = stacked[one.joint]
            error = float(np.linalg.norm(R[:, -1] - R[:, :-1] @ chi))
            freedom = one.rows - 1 if self.by_samples else one.rows - _rank(R[:, :-1])
            result[one.joint] = max(error / np.sqrt(max(freedom, 1)), floor, 1e-300)
        return result

    def _common(self, sigma: Mapping[int, float]) -> float:
        """Variance of all residuals together, ||e||^2 / (r - b) (report eq. 43)."""
        rows = sum(one.rows for one in self.factors)
        freedoms = {
            one.joint: one.rows - 1 if self.by_samples else one.rows - _rank(self._reduced(one)[:, :-1])
            for one in self.factors
        }
        square = sum(sigma[joint] ** 2 * max(freedom, 1) for joint, freedom in freedoms.items())
        return square / max(rows - (1 if self.by_samples else len(self.names)), 1)

    def _solution(self, solved: _Solved, sigma: Mapping[int, float], variance: float, plain: _Solved) -> Solution:
        hidden = tuple(name for name, out in zip(self.names, solved.hidden, strict=True) if out)
        values = {**self.fixed, **dict(zip(self.names, solved.chi.tolist(), strict=True))}
        return Solution(
            names=self.names,
            values=values,
            covariance=variance * solved.inverse,
            hidden=hidden,
            sigma=sigma,
            condition=plain.condition,
            scaled_condition=plain.scaled_condition,
            rank=plain.rank,
        )


@dataclass(frozen=True)
class _Solved:
    """min ||z - R chi||: chi, (R^T R)^+, the hidden parameters."""

    chi: Array
    inverse: Array
    hidden: NDArray[np.bool_]
    condition: float
    scaled_condition: float
    rank: int

    @classmethod
    def of(cls, stacked: Array) -> _Solved:
        """By the singular values of R with columns of unit length."""
        reduced = triangular(stacked)
        R, z = reduced[:, :-1], reduced[:, -1]
        count = R.shape[1]
        size = np.linalg.norm(R, axis=0)
        silent = size <= 1e-12 * size.max(initial=0.0) if count else np.zeros(0, dtype=bool)
        scale = np.where(silent, 1.0, size)
        scaled = np.where(silent, 0.0, R / scale)
        if not count or silent.all():
            return cls(np.zeros(count), np.zeros((count, count)), silent, np.inf, np.inf, 0)
        U, s, Vt = np.linalg.svd(scaled, full_matrices=True)
        s = np.concatenate([s, np.zeros(count - len(s))])
        seen = s > _RANK * s[0]
        rank = int(seen.sum())
        V, s_seen = Vt[:rank].T, s[:rank]
        chi = (V @ ((U[:, :rank].T @ z) / s_seen)) / scale
        inverse = ((V / s_seen**2) @ V.T) / np.outer(scale, scale)
        hidden = silent | (np.abs(Vt[rank:]).max(axis=0, initial=0.0) > _INVOLVED)
        whole = rank == count
        condition = float(np.linalg.cond(R)) if whole else np.inf
        return cls(chi, inverse, hidden, condition, float(s[0] / s_seen[-1]) if whole else np.inf, rank)


def _rank(R: Array) -> int:
    """Number of independent columns, each taken in units of its length."""
    size = np.linalg.norm(R, axis=0)
    live = R[:, size > 1e-12 * size.max(initial=0.0)] if R.size else R
    if not live.size:
        return 0
    s = np.linalg.svd(live / np.linalg.norm(live, axis=0), compute_uv=False)
    return int((s > _RANK * s[0]).sum())


def parameters_of(factors: Sequence[Factor]) -> tuple[str, ...]:
    """The parameters of all factors, in the order of their first appearance."""
    return tuple(dict.fromkeys(name for one in factors for name in one.names))
