"""Joints whose friction follows two variables at once: their speed and place, or their direction and another's place.

Along runs that do not repeat no map of one variable takes it out of the noise.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import f

from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.lack_of_fit import CHANCE

Array = NDArray[np.float64]

#: Part of the residual's squares that it must be: a fifth of the noise's rms.
_LEAST = 0.04
#: Powers of a place, from -1 to 1 along its range.
_POWERS = (1, 2, 3)
#: Rows for each column, at least.
_ROWS = 8


def crossed(found: Search, weights: Mapping[int, float]) -> dict[int, tuple[str, float]]:
    """By coordinate, what friction follows in words, and its part of the squares that values of columns by number leave
    of runs that do not repeat, where it is no chance.
    """
    bank = found.bank
    alone = [r for r, run in enumerate(bank.runs) if not run.period]
    result = {}
    for k in range(bank.dof if alone else 0):
        e = np.concatenate([bank.residual(r, k, weights) for r in alone])
        parts = {what: _part(e, X, bank.dof) for what, X in _columns(bank, alone, k).items()}
        what = max(parts, key=lambda one: parts[one])
        if parts[what] > _LEAST:
            result[k] = (what, parts[what])
    return result


def _part(e: Array, X: Array, tried: int) -> float:
    """Part of the squares of e (N) that the rows of X (m x N) explain; 0 where it may be the chance of some tries."""
    rank = len(X)
    if len(e) < _ROWS * rank:
        return 0.0
    explained = float(np.sum((np.linalg.qr(X.T)[0].T @ e) ** 2))
    left = float(e @ e) - explained
    ratio = (explained / rank) / max(left / (len(e) - rank), 1e-300)
    return explained / float(e @ e) if tried * float(f.sf(ratio, rank, len(e) - rank)) < CHANCE else 0.0


def _columns(bank: Bank, alone: Sequence[int], k: int) -> dict[str, Array]:
    """White kept rows (m x N) of friction on coordinate k, by what it follows."""
    motions = [bank.scenes[r].motion for r in alone]
    numbers = bank.robot.numbers
    result = {}
    for j, number in enumerate(numbers):
        ends = [(float(one.q[j].min()), float(one.q[j].max())) for one in motions]
        lower, upper = min(low for low, _ in ends), max(high for _, high in ends)
        parts = []
        for r, motion in zip(alone, motions, strict=True):
            place = (2 * motion.q[j] - lower - upper) / max(upper - lower, 1e-12)
            friction = motion.qd[k] if j == k else np.sign(motion.qd[k])
            run = bank.runs[r]
            rows = run.decimated(np.stack([friction * place**power for power in _POWERS]))
            parts.append(bank.colours[r][k].white(rows, run.kept[k]))
        result["its speed by its place" if j == k else f"its direction by the place of joint {number}"] = (
            np.concatenate(parts, axis=1)
        )
    return result
