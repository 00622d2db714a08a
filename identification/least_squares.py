"""Least squares on triangular factors: solution, rank, and what cannot be seen (report eq. 40-45)."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from generator.words import listed
from identification.arrays import Array
from identification.factors import Factor, triangular
from identification.rank import in_lengths, nonzero, not_identifiable

#: Residuals that are rounding, in parts of the torques, and the smallest number that one may divide by.
_ROUNDING, _TINY = 1e-12, 1e-300
_REWEIGHTINGS = 2


@dataclass(frozen=True)
class Solution:
    """Parameters by name, their order in ``covariance`` (p x p), and the ``hidden`` ones.

    ``values`` hold the fixed parameters too. Hidden ones have a value that only serves to estimate torques, zero where
    no row shows them in any sum; their variance is infinite. ``sigma`` is the residual's standard deviation by joint
    [N m, N], ``condition`` that of W, ``scaled_condition`` with columns of unit length, and ``rank`` the number of
    independent columns.
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
        return standard_deviation(name, self.names, self.hidden, self.covariance)

    def relative_std(self, name: str) -> float:
        """Standard deviation in % of the value (report eq. 45)."""
        std, value = self.std(name), abs(self.values[name])
        if std == 0:
            return 0.0
        return 100 * std / value if value else float("inf")


def standard_deviation(name: str, names: Sequence[str], hidden: Collection[str], covariance: Array) -> float:
    """Of one of the estimated ``names``, whose covariance is p x p; infinite if it is hidden, zero if it is none."""
    if name in hidden:
        return float("inf")
    if name not in names:
        return 0.0
    k = names.index(name)
    return float(np.sqrt(covariance[k, k]))


def not_shown(hidden: Sequence[str], by: str) -> list[str]:
    """The note on parameters that are ``hidden``: no ``by`` shows any of them by itself. None where none is."""
    if not hidden:
        return []
    shown = "it alone" if len(hidden) == 1 else "any of them alone"
    return [f"{listed(hidden)} cannot be identified: no {by} shows {shown}"]


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

    def hold(self, name: str, others: tuple[str, ...]) -> bool:
        """Whether ``others`` explain all that ``name`` would, so that nothing is lost where it is zero."""
        return name in replace(self, names=(*others, name)).solve().hidden

    def scales(self, sigma: Mapping[int, float]) -> Mapping[int, float]:
        """What the rows are divided by, by joint: ``sigma`` [N m, N] where they are weighted, else 1."""
        return sigma if self.weighted else dict.fromkeys(sigma, 1.0)

    def solve(self) -> Solution:
        """Ordinary least squares, or weighted by each joint's own residual (report eq. 39-45)."""
        stacked = {one.joint: self._reduced(one) for one in self.factors}
        freedom = {one.joint: self._freedom(one.rows, _rank(stacked[one.joint][:, :-1])) for one in self.factors}
        ordinary = solved = _Solved.of(np.concatenate(list(stacked.values())))
        sigma = self._sigma(solved.chi, stacked, freedom)
        variance = self._variance(solved, stacked)
        if self.weighted:
            for _ in range(_REWEIGHTINGS):
                solved = _Solved.of(np.concatenate([R / sigma[joint] for joint, R in stacked.items()]))
                sigma = self._sigma(solved.chi, stacked, freedom)
            variance = 1.0
        return self._solution(solved, ordinary, sigma, variance)

    def foreseen(self, truth: Mapping[str, float], sigma: Mapping[int, float]) -> Solution:
        """What ``solve`` finds over rows whose torques are those of ``truth`` with residuals of std ``sigma`` by joint.

        The covariance is how estimates scatter from one draw of the residuals to the next: where rows are not weighted,
        each joint's residuals count with their own variance. The torques of the factors themselves do not count.
        """
        exact = replace(self, factors=tuple(one.with_torques(truth) for one in self.factors))
        stacked = {one.joint: exact._reduced(one) for one in exact.factors}
        ordinary = _Solved.of(np.concatenate(list(stacked.values())))
        scales = self.scales(sigma)
        solved = _Solved.of(np.concatenate([R / scales[joint] for joint, R in stacked.items()]))
        # chi = inverse W^T Y: what one unit of each row's residual moves, in units of its std.
        rows = [R[:, :-1] * (sigma[joint] / scales[joint] ** 2) for joint, R in stacked.items()]
        moved = np.concatenate(rows) @ solved.inverse
        return replace(
            exact._solution(solved, ordinary, sigma, 1.0), values=truth, covariance=np.asarray(moved.T @ moved)
        )

    def _reduced(self, one: Factor) -> Array:
        """[R z] of the free parameters, the fixed ones' part taken from z."""
        R = one.on(self.names)
        given = np.array([self.fixed.get(name, 0.0) for name in one.names])
        R[:, -1] -= one.R[:, :-1] @ given
        return R

    def _freedom(self, rows: int, parameters: int) -> int:
        return max(rows - (1 if self.by_samples else parameters), 1)

    def _sigma(self, chi: Array, stacked: Mapping[int, Array], freedom: Mapping[int, int]) -> dict[int, float]:
        """Standard deviation of each joint's residual: ||e_j||^2 / (r_j - b_j), b_j the rank of its rows."""
        floor = max((one.norm / np.sqrt(max(one.rows, 1)) for one in self.factors), default=1.0) * _ROUNDING + _TINY
        return {joint: max(_error(R, chi) / np.sqrt(freedom[joint]), floor) for joint, R in stacked.items()}

    def _variance(self, solved: _Solved, stacked: Mapping[int, Array]) -> float:
        """Variance of all residuals together, ||e||^2 / (r - b) (report eq. 43)."""
        square = sum(_error(R, solved.chi) ** 2 for R in stacked.values())
        return square / self._freedom(sum(one.rows for one in self.factors), solved.rank)

    def _solution(self, solved: _Solved, plain: _Solved, sigma: Mapping[int, float], variance: float) -> Solution:
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
        scaled, scale, unexcited = in_lengths(R)
        if not count or unexcited.all():
            return cls(np.zeros(count), np.zeros((count, count)), unexcited, np.inf, np.inf, 0)
        U, s, Vt = np.linalg.svd(scaled, full_matrices=True)
        s = np.concatenate([s, np.zeros(count - len(s))])
        rank = int(nonzero(s).sum())
        V, s_seen = Vt[:rank].T, s[:rank]
        chi = np.where(unexcited, 0.0, (V @ ((U[:, :rank].T @ z) / s_seen)) / scale)
        inverse = ((V / s_seen**2) @ V.T) / np.outer(scale, scale)
        hidden = unexcited | not_identifiable(Vt[rank:])
        whole = rank == count
        condition = float(np.linalg.cond(R)) if whole else np.inf
        return cls(chi, inverse, hidden, condition, float(s[0] / s_seen[-1]) if whole else np.inf, rank)


def _error(R: Array, chi: Array) -> float:
    """||z - R chi||."""
    return float(np.linalg.norm(R[:, -1] - R[:, :-1] @ chi))


def _rank(R: Array) -> int:
    """Number of independent columns, each taken in units of its length."""
    scaled, _, _ = in_lengths(R)
    return int(nonzero(np.asarray(np.linalg.svd(scaled, compute_uv=False), dtype=float)).sum())
