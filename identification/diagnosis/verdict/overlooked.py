"""Joints on which something is missing though nothing was found: noise, as it was measured, hides it.

What neither repeats nor follows the motion counts as noise. Where that is most of how a joint's torque varies, and
slow, it is none; and runs that test tell more: a model that lacks nothing leaves as much noise of them as of others.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.noise.noise_floor import noise_floor
from identification.diagnosis.runs.stated_elasticity import stated
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.trial import Trial
from identification.residuals import rms

#: Part of a joint's torque's spread that is no noise, and how often the rms of noise testing runs must keep.
_MOST, _FAR = 0.5, 2.0
#: Rows of the means that are slow, of which white noise keeps a third, and what is not noise half at least; least rows.
_MEANS, _SLOW, _FEWEST = 10, 0.5, 50
#: Eigenvalues of the scaled columns' products, in parts of the largest, of directions that nothing is known of; least
#: size of a column, in parts of the largest; the part of a row along them from which it is not predicted.
_RANK, _DEAD, _BEYOND = 1e-9, 1e-9, 1e-3


def untold(found: Search, weights: Mapping[int, float]) -> dict[int, float]:
    """By coordinate, the part of the torque's spread that values of the columns by number leave slowly, where most."""
    bank, result = found.bank, {}
    for k in range(bank.dof):
        e, tau = bank.left(k, weights, white=False), bank.left(k, {}, white=False)
        if len(e) < _FEWEST or not np.std(tau):
            continue
        if (part := rms(_slow(e)) / float(np.std(tau))) > _MOST:
            result[k] = part
    return result


def untested(found: Search, trial: Trial, standing: Collection[int] = ()) -> dict[int, float]:
    """By coordinate, how often the rms of noise the testing runs keep of what the model predicts, where that is far
    more and slow, with what the other runs leave open of its values counted as noise. Rows close to standstill count
    on ``standing`` coordinates alone.

    Of elastic drive trains that the file states nothing is told: what is linear about stiffnesses that are not known
    does not carry over.
    """
    if stated(found.bank.robot):
        return {}
    theta, C = trial.normal.solution([])
    # Noise of the positions makes values small, which motion of another kind shows.
    right, _ = found.weighing.fitted((), True)
    size, unseen = _unseen(trial.normal.whole[: len(theta), : len(theta)])
    rate = float(np.median([run.rate for run in trial.bank.runs]))
    result = {}
    for k in trial.shown:
        columns, torque = _rows(trial.bank, k, k in standing)
        scaled = columns / size[:, None]
        predicted = np.linalg.norm(unseen @ scaled, axis=0) < _BEYOND * np.linalg.norm(scaled, axis=0)
        X = columns[:, predicted]
        if X.shape[1] < _FEWEST:
            continue
        e = min((torque[predicted] - values @ X for values in (theta, right)), key=rms)
        noise = float(np.sqrt(_loudest(found, k, rate) ** 2 + np.mean(np.sum(X * (C @ X), axis=0))))
        if rms(e) > _FAR * noise and rms(_slow(e)) > _SLOW * rms(e):
            result[k] = rms(e) / noise
    return result


def _rows(bank: Bank, k: int, standing: bool) -> tuple[Array, Array]:
    """Base columns (p x N) and torque (N) [N m, N] of a coordinate, as recorded, without rows close to standstill
    unless ``standing``.
    """
    p, parts = len(bank.base), []
    for r, run in enumerate(bank.runs):
        numbers, columns, torque, kept = bank.raw(r, k)
        rows = kept if standing else kept & ~run.unsettled[k]
        part = np.zeros((p + 1, int(rows.sum())))
        own = [i for i, number in enumerate(numbers) if number < p]
        part[[numbers[i] for i in own]], part[p] = columns[own][:, rows], torque[rows]
        parts.append(part)
    whole = np.concatenate(parts, axis=1)
    return whole[:p], whole[p]


def _loudest(found: Search, k: int, rate: float) -> float:
    """Root mean square of the noise of coordinate k in the run that has most of it."""
    powers = np.square([colours[k].deviations[-1] for colours in found.bank.colours])
    return noise_floor(found.bank, k, rate) * float(np.sqrt(powers.max() / powers.mean()))


def _unseen(products: Array) -> tuple[Array, Array]:
    """Sizes of base columns (p) from their products (p x p), and directions (m x p) of the columns in parts of these of
    which the products show nothing.
    """
    size = np.sqrt(np.maximum(np.diag(products), 0.0))
    size = np.maximum(size, _DEAD * size.max())
    values, vectors = np.linalg.eigh(products / np.outer(size, size))
    return size, np.asarray(vectors[:, values < _RANK * values.max()].T)


def _slow(x: Array) -> Array:
    """Means of rows in a row."""
    count = len(x) // _MEANS
    return np.asarray(x[: count * _MEANS].reshape(count, _MEANS).mean(axis=1))
