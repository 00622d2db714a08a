"""Joints on which something is missing though nothing was found: noise, as it was measured, hides it.

What neither repeats nor follows the motion counts as noise. Where that is most of a joint's torque it is none, and runs
that test tell more: a model that lacks nothing leaves as much noise of them as of the others.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.loop import Search
from identification.diagnosis.noise_floor import noise_floor
from identification.diagnosis.trial import Trial

Array = NDArray[np.float64]

#: Part of a joint's torque's spread that is no noise, and how often the rms of noise testing runs must keep.
_MOST, _FAR = 0.5, 2.0
#: Eigenvalues of the scaled columns' products, in parts of the largest, of directions that nothing is known of; the
#: part of a row along them from which it is not predicted; least rows.
_RANK, _BEYOND, _FEWEST = 1e-9, 1e-3, 50


def untold(found: Search, weights: Mapping[int, float]) -> dict[int, float]:
    """By coordinate, the part of the torque's spread that values of the columns by number leave, where it is most."""
    bank, result = found.bank, {}
    for k in range(bank.dof):
        parts = [(bank.residual(r, k, weights, white=False), *bank.raw(r, k)[2:]) for r in range(len(bank.runs))]
        e = np.concatenate([left[kept] for left, _, kept in parts])
        tau = np.concatenate([torque[kept] for _, torque, kept in parts])
        spread = float(np.sqrt(np.mean((tau - tau.mean()) ** 2))) if len(tau) else 0.0
        if spread and (part := float(np.sqrt(np.mean(e**2))) / spread) > _MOST:
            result[k] = part
    return result


def untested(found: Search, trial: Trial) -> dict[int, float]:
    """By coordinate, how often the rms of noise the testing runs keep of what the model predicts, where that is far
    more, with what the other runs leave open of its values counted as noise.
    """
    theta, C = trial.fitted(())
    p, result = trial.normal.base, {}
    size, unseen = _unseen(trial.normal.whole[:p, :p])
    filters = found.bank.runs[0].sampled.filters
    for k, (columns, torque) in trial.recorded.items():
        scaled = columns[:p] / size[:, None]
        told = np.linalg.norm(unseen @ scaled, axis=0) < _BEYOND * np.linalg.norm(scaled, axis=0)
        X, e = columns[:, told], (torque - theta @ columns)[told]
        if len(e) < _FEWEST:
            continue
        noise = noise_floor(found.bank, k, filters.rate / filters.factor) ** 2 + np.einsum("in,ij,jn->n", X, C, X)
        if (often := float(np.sqrt(np.mean(e**2) / np.mean(noise)))) > _FAR:
            result[k] = often
    return result


def _unseen(products: Array) -> tuple[Array, Array]:
    """Sizes of base columns (p) from their products (p x p), and directions (m x p) of the columns in parts of these of
    which the products show nothing.
    """
    size = np.sqrt(np.maximum(np.diag(products), 1e-300))
    values, vectors = np.linalg.eigh(products / np.outer(size, size))
    return size, np.asarray(vectors[:, values < _RANK * values.max()].T)
