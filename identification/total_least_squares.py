"""Total least squares of currents against a model: k_m i_m = B_m chi + w_m, noise in the currents alone (eq. 51-57).

With rows [V -B -w] (report eq. 53) the solution is the right singular vector of the smallest singular value, divided by
its last component. Columns are scaled before: those of the model, which are free of noise, to unit length, the currents
by their noise; and the noise-free columns are taken out by projection (mixed total least squares, Van Huffel and
Vandewalle 1991). Without that the noise is laid to the model as well and the gains come out too small.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array
from identification.colour import inflation
from identification.factors import triangular
from identification.rank import RANK, nonzero, not_identifiable

#: Eigenvalues of the scaled information below this part of the largest are zero.
_SEEN = 1e-13
_ITERATIONS, _SETTLED = 20, 1e-6
#: Times a gain of one step, or part of it, that it may be in the next: the largest factor between units of a current,
#: from uA to A. Beyond, nothing that is known holds it.
_RUNAWAY = 1e6
_TINY = 1e-300


@dataclass(frozen=True)
class Part:
    """Rows of one unknown gain, number ``gain``: ``B`` (rows x p), known part ``w`` (rows), currents ``i`` (rows)."""

    gain: int
    B: Array
    w: Array
    i: Array


@dataclass(frozen=True)
class Fit:
    """Gains ``k`` (n), parameters ``chi`` (p), covariance of [k, chi], which of chi are ``hidden`` (p).

    ``scale`` is the part of the known column that no parameter can stand for; 0 where the scale of all is open.
    ``unsettled`` tells that the steps to the gains come to no end. ``sigma`` is the noise of each current as its own
    rows tell it, ``misfit`` (n) what errors are in parts of it, at least 1. ``separation`` is the second
    smallest singular value over the smallest, ``condition`` that of the rows' derivatives by gains and parameters,
    columns of unit length.
    """

    k: Array
    chi: Array
    covariance: Array
    hidden: NDArray[np.bool_]
    scale: float
    sigma: Array
    separation: float
    condition: float = np.inf
    unsettled: bool = False
    misfit: Array = field(default_factory=lambda: np.ones(0))

    def errors(self, part: Part) -> Array:
        """k i - B chi - w of a part (rows)."""
        error: Array = self.k[part.gain] * part.i - part.B @ self.chi - part.w
        return error


def solve(parts: Sequence[Part], gains: int) -> Fit:
    """Gains and parameters of all ``parts``; gains without rows are zero, with an infinite variance.

    Standard deviations are those of a first-order perturbation by the residuals of each part, as large as they are and
    as coloured (``inflation``). They are infinite where the scale is open or the steps run away.
    """
    p = parts[0].B.shape[1]
    rows = np.array([sum(len(one.i) for one in parts if one.gain == m) for m in range(gains)])
    live = np.flatnonzero(rows)
    reduced = [_Reduced.of([one for one in parts if one.gain == m]) for m in live]
    sigma = np.ones(gains)
    sigma[live] = [one.noise() for one in reduced]
    k, chi, scale, separation = np.ones(gains), np.zeros(p), 0.0, 0.0
    hidden = np.zeros(p, dtype=bool)
    unsettled = False
    for step in range(_ITERATIONS):
        previous = k
        k, chi, hidden, scale, separation = _once(reduced, live, np.maximum(np.abs(k), _TINY)[live], sigma[live], gains)
        change = _change(k[live], previous[live])
        unsettled = scale > 0.0 and bool(np.any(change > _SETTLED))
        if step and np.any(change > _RUNAWAY):
            scale = 0.0
        if scale == 0.0 or not unsettled:
            break
    fit = Fit(k, chi, np.zeros((0, 0)), hidden, scale, sigma, separation, unsettled=unsettled)
    if not scale:
        return replace(fit, covariance=np.full((gains + p, gains + p), np.inf))
    covariance, condition = _covariance(fit, parts, live)
    return replace(fit, covariance=covariance, condition=condition, misfit=_misfit(fit, parts, live))


@dataclass(frozen=True)
class _Reduced:
    """The triangular factor ``T`` of [B w i] of one gain's ``rows`` rows."""

    T: Array
    rows: int

    @classmethod
    def of(cls, parts: Sequence[Part]) -> _Reduced:
        stacked = np.concatenate([np.column_stack([one.B, one.w, one.i]) for one in parts])
        return cls(triangular(stacked), len(stacked))

    def noise(self) -> float:
        """Standard deviation of the current's noise, from a fit of these rows with parameters of their own."""
        A, i = self.T[:, :-1], self.T[:, -1]
        U, s, _ = np.linalg.svd(A / (np.linalg.norm(A, axis=0) + _TINY), full_matrices=False)
        U = U[:, nonzero(s)]
        error = np.linalg.norm(i - U @ (U.T @ i))
        floor = 1e-9 * float(np.linalg.norm(i)) / np.sqrt(self.rows) + _TINY
        return max(float(error / np.sqrt(max(self.rows - U.shape[1], 1))), float(floor))


def _once(
    reduced: Sequence[_Reduced], live: NDArray[np.int64], k: Array, sigma: Array, count: int
) -> tuple[Array, Array, NDArray[np.bool_], float, float]:
    """The solution with rows in units of their noise for gains near ``k``; ``count`` gains, the ``live`` with rows."""
    p = reduced[0].T.shape[1] - 2
    stacked = []
    for number, one in enumerate(reduced):
        V = np.zeros((len(one.T), len(live)))
        V[:, number] = one.T[:, -1]
        stacked.append(np.column_stack([one.T[:, :-1], V]) / (k[number] * sigma[number]))
    T = triangular(np.concatenate(stacked))
    size = np.linalg.norm(T[:, : p + 1], axis=0)
    size[size == 0.0] = 1.0
    A, noise = T[:, : p + 1] / size, np.sqrt([one.rows for one in reduced]) / k
    U, s, Vt = np.linalg.svd(A[:, :p], full_matrices=True)
    rank = int(nonzero(s).sum())
    hidden = not_identifiable(Vt[rank:])
    own = A[:, p] - U[:, :rank] @ (U[:, :rank].T @ A[:, p])
    scale = float(np.linalg.norm(own))
    gains = np.zeros(count)
    if scale <= 1e-6:
        return gains, np.zeros(p), hidden, 0.0, 0.0
    basis = np.column_stack([U[:, :rank], own / scale])
    V = T[:, p + 1 :] / noise
    left = V - basis @ (basis.T @ V)
    values, right = np.linalg.svd(left)[1:]
    y = right[-1]
    last = float(own @ (V @ y)) / scale**2 / size[p]
    y = y / (last if last else _TINY)
    gains[live] = y / noise
    target = V @ y - A[:, p] * size[p]
    chi = (Vt[:rank].T @ ((U[:, :rank].T @ target) / s[:rank])) / size[:p]
    separation = float(values[-2] / max(values[-1], _TINY)) if len(values) > 1 else np.inf
    return gains, chi, hidden, scale, separation


def _change(k: Array, previous: Array) -> Array:
    """Of gains from a step to the next, in parts of the smaller of both."""
    now, before = np.abs(k), np.abs(previous)
    change: Array = np.abs(k - previous) / (np.minimum(now, before) + _TINY)
    return change


def _covariance(fit: Fit, parts: Sequence[Part], live: NDArray[np.int64]) -> tuple[Array, float]:
    """Of [k, chi], by the derivatives of the rows at the solution, with the currents that the model gives; and the
    condition of those derivatives with columns of unit length, without those that are zero.
    """
    n, p = len(fit.k), len(fit.chi)
    gram, coloured = np.zeros((n + p, n + p)), np.zeros((n + p, n + p))
    for m in live:
        weight = 1 / (abs(fit.k[m]) * fit.sigma[m] + _TINY) ** 2
        for one in (each for each in parts if each.gain == m and len(each.i)):
            J, e = _derivative(fit, one, n), fit.errors(one)
            own = weight * J.T @ J
            gram += own
            # What the motors' common parameters leave is more than noise where the model lacks something.
            coloured += weight * own * (float(e @ e) / len(e) * inflation(e))
    size = np.sqrt(np.diag(gram))
    silent = size <= RANK * size.max(initial=0.0)
    size[silent] = 1.0
    values, vectors = np.linalg.eigh(gram / np.outer(size, size))
    seen = nonzero(values, _SEEN)
    rows = sum(len(one.i) for one in parts)
    coloured *= rows / max(rows - int((seen & (values > 0)).sum()), 1)
    inverse = (vectors[:, seen] / values[seen]) @ vectors[:, seen].T / np.outer(size, size)
    result: Array = inverse @ coloured @ inverse
    unseen = silent | not_identifiable(vectors[:, ~seen].T)
    result[unseen, unseen] = np.inf
    powers = np.linalg.eigvalsh((gram / np.outer(size, size))[np.ix_(~silent, ~silent)])
    condition = float(np.sqrt(powers[-1] / powers[0])) if powers[0] > _SEEN * powers[-1] else np.inf
    return result, condition


def _misfit(fit: Fit, parts: Sequence[Part], live: NDArray[np.int64]) -> Array:
    result = np.ones(len(fit.k))
    for m in live:
        errors = np.concatenate([fit.errors(one) for one in parts if one.gain == m])
        result[m] = max(1.0, np.sqrt(np.mean(errors**2)) / (abs(fit.k[m]) * fit.sigma[m] + _TINY))
    return result


def _derivative(fit: Fit, part: Part, gains: int) -> Array:
    V = np.zeros((len(part.i), gains))
    k = fit.k[part.gain]
    V[:, part.gain] = (part.B @ fit.chi + part.w) / (k if k else _TINY)
    return np.column_stack([V, -part.B])
