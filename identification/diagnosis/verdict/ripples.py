"""Joints whose torque ripples along their range, at one period that no effect of the library has.

Where nothing repeats such a ripple counts as noise: it is too fine for maps of the range, and does not fade like one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import f

from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.lack_of_fit import CHANCE

Array = NDArray[np.float64]

#: Part of the residual's squares that a ripple must be.
_LEAST = 0.1
#: Fewest ripples along the range, and periods that are tried for each that the range tells apart.
_FEWEST, _FINE = 4, 4
#: Part of half a turn by which a ripple advances from row to row, at the joint's rms speed, in the finest tried.
_ADVANCE = 0.8
#: Fewest rows of a joint.
_ROWS = 100


@dataclass(frozen=True)
class Ripple:
    """Its ``length`` along the range [rad, m], and the ``part`` of the residual's squares that it is."""

    length: float
    part: float


def ripples(found: Search, weights: Mapping[int, float]) -> dict[int, Ripple]:
    """By coordinate, the ripple of runs that do not repeat with values of columns by number, where it is no chance."""
    bank = found.bank
    alone = [r for r, run in enumerate(bank.runs) if not run.period]
    result = {}
    for k in range(bank.dof):
        waves = _waves(bank, alone, k)
        if not len(waves):
            continue
        raw = np.concatenate([bank.residual(r, k, weights, white=False) for r in alone])
        q = np.concatenate([bank.runs[r].decimated(bank.scenes[r].motion.q[k]) for r in alone])
        kept = np.concatenate([bank.runs[r].kept[k] for r in alone])
        turns = np.exp(1j * np.outer(waves, q[kept]))
        best = float(waves[int(np.argmax(np.abs(turns @ raw[kept])))])
        one = _fitted(bank, alone, k, best, weights, len(waves))
        if one is not None:
            result[k] = one
    return result


def _waves(bank: Bank, alone: Sequence[int], k: int) -> Array:
    """Wave numbers [rad/rad, rad/m] that are tried; none where rows are few."""
    if sum(int(bank.runs[r].kept[k].sum()) for r in alone) < _ROWS:
        return np.zeros(0)
    motions = [bank.scenes[r].motion for r in alone]
    length = max(float(one.q[k].max()) for one in motions) - min(float(one.q[k].min()) for one in motions)
    speed = float(np.sqrt(np.mean(np.concatenate([one.qd[k] ** 2 for one in motions]))))
    if not length or not speed:
        return np.zeros(0)
    finest = _ADVANCE * np.pi * min(bank.runs[r].rate for r in alone) / speed
    return np.asarray(np.arange(_FEWEST * _FINE, finest * length * _FINE / (2 * np.pi)) * 2 * np.pi / (length * _FINE))


def _fitted(
    bank: Bank, alone: Sequence[int], k: int, wave: float, weights: Mapping[int, float], tried: int
) -> Ripple | None:
    """A ripple of wave number ``wave``, the best of those ``tried``, by the white rows of all runs; None by chance."""
    e = np.concatenate([bank.residual(r, k, weights) for r in alone])
    X = np.concatenate([_columns(bank, r, k, wave) for r in alone], axis=1)
    explained = float(np.sum((np.linalg.qr(X.T)[0].T @ e) ** 2))
    left = float(e @ e) - explained
    free = len(e) - len(X)
    ratio = (explained / len(X)) / max(left / free, 1e-300)
    part = explained / float(e @ e)
    by_chance = tried * float(f.sf(ratio, len(X), free)) > CHANCE
    return None if by_chance or part < _LEAST else Ripple(2 * np.pi / wave, part)


def _columns(bank: Bank, r: int, k: int, wave: float) -> Array:
    """White kept rows (2 x N) of cosine and sine along the range."""
    run, angle = bank.runs[r], wave * bank.scenes[r].motion.q[k]
    rows = run.decimated(np.stack([np.cos(angle), np.sin(angle)]))
    return np.asarray(bank.colours[r][k].white(rows, run.kept[k]))
