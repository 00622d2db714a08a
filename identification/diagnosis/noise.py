"""The noise of each joint in each run: what is left when everything that may act has been taken away.

Base parameters and all hypotheses together explain more than the truth can, so that what they leave is noise and not a
missing effect; those that hold the record's own noise stay away. Where a motion repeats, what its periods have in
common is taken away too: only what differs between them is noise, whatever the model lacks.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.bank import Bank
from identification.diagnosis.normal import inverse
from identification.diagnosis.whitening import Colour, colour, stretches

Array = NDArray[np.float64]

#: Eigenvalues of the scaled columns' products below this part of the largest are no directions of their own.
_RANK = 1e-7
#: Rows that a column may use up: with more columns only the strongest directions are taken away.
_ROWS = 8
#: Rows of noise of the usual power that every run is taken to have beside its own.
_DOUBT = 200
#: Times that the colour is estimated, each from rows made white by the last.
_PASSES = 2


def colours(bank: Bank, rounded: Sequence[Array] = ()) -> list[list[Colour]]:
    """The colour of every joint's noise, run by run: the form is that of all runs, which a short one could not tell.

    ``rounded`` (n x rows each) counts as noise too, though periods may have it in common.
    """
    every = [_joint(bank, joint, [one[joint] for one in rounded]) for joint in range(bank.dof)]
    return [[colours[r] for colours in every] for r in range(len(bank.runs))]


def _joint(bank: Bank, joint: int, rounded: Sequence[Array]) -> list[Colour]:
    """The colour of a joint's noise in each run."""
    known: Colour | None = None
    left: list[list[Array]] = []
    freedom = 1.0
    for _ in range(_PASSES):
        left, freedom = _left(bank, joint, known, rounded)
        known = colour([part for parts in left for part in parts], freedom)
    assert known is not None
    return [_scaled(known, parts, freedom) for parts in left]


def _left(bank: Bank, joint: int, known: Colour | None, rounded: Sequence[Array]) -> tuple[list[list[Array]], float]:
    """Stretches of noise of each run, and the part of its variance that is left in them."""
    parts = [_without_record(bank, r, joint) for r in range(len(bank.runs))]
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
    weights, rank = _explained(gram, sum(number < len(bank.base) for number in numbers), rows)
    freedom = max(1 - rank / max(rows, 1), 0.1)
    left: list[list[Array]] = []
    shares = 0.0
    for r, ((mine, columns, tau, kept), run) in enumerate(zip(parts, bank.runs, strict=True)):
        e = tau - weights[[place[number] for number in mine]] @ columns
        e, share = _between_periods(e, kept, run.period)
        left.append(stretches(e + rounded[r] if rounded else e, kept))
        shares += share * int(kept.sum()) / max(rows, 1)
    return left, freedom * shares if rows else 1.0


def _without_record(bank: Bank, run: int, joint: int) -> tuple[list[int], Array, Array, NDArray[np.bool_]]:
    """Raw rows of a joint without columns that hold the record's own noise."""
    noisy = {number for one in bank.variants if one.hypothesis.recorded for number in one.columns}
    numbers, columns, tau, kept = bank.raw(run, joint)
    quiet = [i for i, number in enumerate(numbers) if number not in noisy]
    return [numbers[i] for i in quiet], columns[quiet], tau, kept


def _scaled(known: Colour, parts: list[Array], freedom: float) -> Colour:
    """The colour with the power of one run's noise, as far as its rows tell it."""
    squares, rows = 0.0, 0
    for part in parts:
        white = known.white(part[None], np.ones(len(part), dtype=bool))[0]
        squares, rows = squares + float(white @ white), rows + len(part)
    power = (squares / freedom + _DOUBT) / (rows + _DOUBT)
    return Colour(known.filters, tuple(float(x) * float(np.sqrt(power)) for x in known.deviations))


def _explained(gram: Array, base: int, rows: int) -> tuple[Array, int]:
    """Weights of the columns that explain the last one best, and how many directions they use.

    The first ``base`` columns are those of the model, which all count if there are rows enough.
    """
    most = max(rows // _ROWS, 1)
    base = base if base < most else 0
    B = inverse(gram[:base, :base])
    S = gram[base:, base:] - gram[base:, :base] @ B @ gram[:base, base:]
    size = np.sqrt(np.maximum(np.diag(gram)[base:], 1e-300))
    scaled = S / np.outer(size, size)
    values, vectors = np.linalg.eigh((scaled[:-1, :-1] + scaled[:-1, :-1].T) / 2)
    seen = np.flatnonzero(values > _RANK * max(values.max(initial=0.0), 1e-300))
    seen = seen[base - most :]
    V = vectors[:, seen]
    weights = V @ ((V.T @ scaled[:-1, -1]) / values[seen]) * size[-1] / size[:-1]
    model = B @ (gram[:base, -1] - gram[:base, base:-1] @ weights)
    return np.concatenate([model, weights]), base + len(seen)


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
