"""Covariance of the parameters when torques are measured with noise (instead of report eq. 68).

The open loop integrates the noise of the torques, so that errors of positions are neither small nor independent, and
sigma^2 (s^T s)^-1 would be far too small. With errors e = -(response to the noise n) the estimate moves by
B^-1 S^T e, a weighted integral of the noise; its weight at each instant is what an impulse of torque does to S^T e,
found by one run of the variations backward. The covariance is B^-1 (sum of weight density weight^T) B^-1, a sandwich.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array
from identification.colour import inflation
from identification.output_error.criterion import Criterion, Linearised, Reduced
from identification.output_error.experiment import Experiment

#: How often joints are weighted by their residuals, dependent columns, and what may be divided by.
_WEIGHTINGS, _RANK, _TINY = 3, 1e-8, 1e-12


def covariance(criterion: Criterion, at: Linearised, reduced: Reduced, inverse: Array, density: Array) -> Array:
    """Of the sought parameters (b x b).

    ``inverse`` (b x b) is that of the normal equations, ``density`` (n x n) that of the torques' noise.
    """
    b = len(criterion.sought)
    meat = np.zeros((b, b))
    for one, S, varied, by_chi in zip(criterion.experiments, at.slopes, at.sensitivity, reduced.by_chi, strict=True):
        size = S.shape[-1] - b
        # Derivatives by the parameters with the first states following them: what remains when states are eliminated.
        following = S[..., size:] - np.einsum("sknx,sxb->sknb", S[..., :size], by_chi)
        weights = following / (criterion.scale**2)[:, None]
        impulse = varied.backward(weights).reshape(-1, b, density.shape[0])
        meat += one.step * np.einsum("kbi,ij,kcj->bc", impulse, density, impulse, optimize=True)
        noisy = (weights * one.noise[:, None]).reshape(-1, b)
        meat += noisy.T @ noisy
    result: Array = inverse @ meat @ inverse
    return (result + result.T) / 2


def noise_density(criterion: Criterion) -> Array:
    """Spectral density at frequency zero of the torques' noise (n x n) [(N m)^2 s, N^2 s].

    The noise is what the best fit of the inverse model leaves of the recorded torques on the filtered motion, in means
    over the recipe's decimation. Those in which a joint is slower than the recipe's threshold are left out; the
    correlation from one to the next is as found.
    """
    sampled = [_means_of(one, criterion) for one in criterion.experiments]
    errors, freedom = _unexplained(sampled)
    n = errors[0].shape[1]
    square, count, power = np.zeros((n, n)), np.zeros((n, n)), np.zeros(n)
    for e, (_, _, kept), one in zip(errors, sampled, criterion.experiments, strict=True):
        square += one.filters.factor * one.period * e.T @ e
        count += kept.T.astype(float) @ kept
        power += [kept[:, k].sum() * inflation(e[kept[:, k], k]) for k in range(n)]
    colour = np.sqrt(power / np.maximum(np.diag(count), 1) / freedom)
    result: Array = square / np.maximum(count, 1) * np.outer(colour, colour)
    return result


#: Means of torques without the fixed parameters' (R x n), of the sought ones' columns (R x n x b), and which are used.
_Sampled = tuple[Array, Array, NDArray[np.bool_]]


def _means_of(one: Experiment, criterion: Criterion) -> _Sampled:
    window, samples = one.filters.factor, one.motion.samples
    q, qd, qdd = (np.ascontiguousarray(x.T) for x in (one.motion.q, one.motion.qd, one.motion.qdd))
    loop = criterion.loop(np.zeros(len(criterion.sought)))
    tau = _means(one.recorded - loop.model.inverse_dynamics(q, qd, qdd), window)
    W = loop.model.observation_matrix(q, qd, qdd).reshape(samples, q.shape[1], -1)[:, :, criterion.columns]
    kept = _means((np.abs(qd) < one.slow).astype(float), window) == 0
    return tau, _means(W, window), kept


def _unexplained(sampled: Sequence[_Sampled]) -> tuple[list[Array], float]:
    """Residuals (R x n) of the fit, 0 where they are not used, and the part of their variance that the fit leaves."""
    scale = np.ones(sampled[0][0].shape[1])
    rows, rank, errors = 1, 0, [tau for tau, _, _ in sampled]
    for _ in range(_WEIGHTINGS):
        A = np.concatenate([(W / scale[:, None])[kept] for _, W, kept in sampled])
        y = np.concatenate([(tau / scale)[kept] for tau, _, kept in sampled])
        size = np.maximum(np.linalg.norm(A, axis=0), _TINY)
        chi, _, rank, _ = np.linalg.lstsq(A / size, y, rcond=_RANK)
        rows = len(y)
        errors = [np.where(kept, tau - W @ (chi / size), 0.0) for tau, W, kept in sampled]
        power = sum((e**2).sum(axis=0) for e in errors) / sum(kept.sum(axis=0).clip(1) for _, _, kept in sampled)
        scale = np.maximum(np.sqrt(power), _TINY)
    return errors, max(rows - int(rank), 1) / max(rows, 1)


def _means(x: Array, window: int) -> Array:
    """Of each ``window`` consecutive samples (N x ...)."""
    count = len(x) // window
    result: Array = x[: count * window].reshape(count, window, *x.shape[1:]).mean(axis=1)
    return result
