"""The noise of each joint in each run: what is left when everything that may act has been taken away.

Base parameters and all hypotheses together explain more than the truth can, so that what they leave is noise and not a
missing effect. Where a motion repeats, what its periods have in common is taken away too: only what differs between
them is noise, whatever the model lacks.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.bank import Bank
from identification.diagnosis.whitening import Colour, colour, stretches

Array = NDArray[np.float64]

#: Eigenvalues of the scaled columns' products below this part of the largest are no directions of their own.
_RANK = 1e-7
#: Rows that a column may use up: with more columns only the strongest directions are taken away.
_ROWS = 8
#: Times that the colour is estimated, each from rows made white by the last.
_PASSES = 2


def colours(bank: Bank) -> list[list[Colour]]:
    """The colour of every joint's noise, run by run; all runs have the same, which a short one could not tell."""
    every = []
    for joint in range(bank.dof):
        known: Colour | None = None
        for _ in range(_PASSES):
            known = _joint(bank, joint, known)
        assert known is not None
        every.append(known)
    return [list(every) for _ in bank.runs]


def _joint(bank: Bank, joint: int, known: Colour | None) -> Colour:
    parts = [bank.raw(r, joint) for r in range(len(bank.runs))]
    numbers = sorted({number for part in parts for number in part[0]})
    place = {number: i for i, number in enumerate(numbers)}
    gram = np.zeros((len(numbers) + 1, len(numbers) + 1))
    rows = 0
    for mine, columns, tau, kept in parts:
        x = np.concatenate([columns, tau[None]])
        x = x[:, kept] if known is None else known.white(x, kept)
        at = [*(place[number] for number in mine), len(numbers)]
        gram[np.ix_(at, at)] += x @ x.T
        rows += x.shape[1]
    weights, rank = _explained(gram, rows)
    freedom = max(1 - rank / max(rows, 1), 0.1)
    left: list[Array] = []
    shares = 0.0
    for (mine, columns, tau, kept), run in zip(parts, bank.runs, strict=True):
        e = tau - weights[[place[number] for number in mine]] @ columns
        e, share = _between_periods(e, kept, run.period)
        left += stretches(e, kept)
        shares += share * int(kept.sum()) / max(rows, 1)
    return colour(left, freedom * shares)


def _explained(gram: Array, rows: int) -> tuple[Array, int]:
    """Weights of the columns that explain the last one best, and how many directions they use."""
    size = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    scaled = gram / np.outer(size, size)
    values, vectors = np.linalg.eigh(scaled[:-1, :-1])
    seen = np.flatnonzero(values > _RANK * values[-1])[-max(rows // _ROWS, 1) :]
    V = vectors[:, seen]
    weights = V @ ((V.T @ scaled[:-1, -1]) / values[seen])
    return np.asarray(weights * size[-1] / size[:-1]), len(seen)


def _between_periods(e: Array, kept: NDArray[np.bool_], period: int) -> tuple[Array, float]:
    """What differs between the periods, and the part of the noise's variance that this keeps."""
    count = len(e) // period if period else 0
    if count < 2:
        return e, 1.0
    used = count * period
    whole, there = e[:used].reshape(count, period), kept[:used].reshape(count, period)
    times = there.sum(axis=0)
    mean = np.where(there, whole, 0.0).sum(axis=0) / np.maximum(times, 1)
    result = e.copy()
    result[:used] = (whole - mean).reshape(-1)
    rest = len(e) - used
    result[used:] -= mean[:rest]
    kept_rows = max(int(kept.sum()), 1)
    return result, float(max(1 - (times > 0).sum() / kept_rows, 0.1))
