"""Joints whose torque ripples along their range, at one period that no effect of the library has.

Where nothing repeats such a ripple counts as noise: it is too fine for maps of the range, and does not fade like one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.maps import ends
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.explained import explained
from identification.diagnosis.verdict.lack_of_fit import CHANCE

Array = NDArray[np.float64]

#: Part of the residual's squares that a ripple must be.
_LEAST = 0.1
#: Fewest ripples along the range, and periods that are tried for each that the range tells apart.
_FEWEST, _FINE = 4, 4
#: Part of half a turn by which a ripple advances from row to row, at the joint's rms speed, in the finest tried.
_ADVANCE = 0.8
#: Places in the finest ripple between which rows are not told apart in looking for it.
_PLACES = 16
#: Fewest rows of a joint.
_ROWS = 100


@dataclass(frozen=True)
class Ripple:
    """Its ``length`` along the range [rad, m], and the ``part`` of the residual's squares that it is."""

    length: float
    part: float


def ripples(found: Search, weights: Mapping[int, float]) -> dict[int, Ripple]:
    """By coordinate, the ripple of runs that do not repeat with values of columns by number, where it is no chance."""
    bank, result = found.bank, {}
    for k in range(bank.dof):
        if sum(int(bank.runs[r].kept[k].sum()) for r in bank.alone) < _ROWS:
            continue
        wave, tried = _strongest(bank, k, weights)
        if not tried:
            continue
        e = np.concatenate([bank.residual(r, k, weights) for r in bank.alone])
        one = explained(np.concatenate([_columns(bank, r, k, wave) for r in bank.alone], axis=1), e)
        if tried * one.p < CHANCE and one.part >= _LEAST:
            result[k] = Ripple(2 * np.pi / wave, one.part)
    return result


def _strongest(bank: Bank, k: int, weights: Mapping[int, float]) -> tuple[float, int]:
    """The wave number [rad/rad, rad/m] of which the residual as recorded holds most, and of how many; 0 of none."""
    motions = [bank.scenes[r].motion for r in bank.alone]
    lower, upper = ends([one.q[k] for one in motions])
    speed = float(np.sqrt(np.mean(np.concatenate([one.qd[k] ** 2 for one in motions]))))
    length = upper - lower
    if not length or not speed:
        return 0.0, 0
    slowest = min(bank.runs[r].rate for r in bank.alone)
    most = _ADVANCE * slowest * length / (2 * speed)
    first, last = _FEWEST * _FINE, int(np.ceil(most * _FINE))
    if last <= first:
        return 0.0, 0
    kept = np.concatenate([bank.runs[r].kept[k] for r in bank.alone])
    e = np.concatenate([bank.residual(r, k, weights, white=False) for r in bank.alone])[kept]
    q = np.concatenate([bank.runs[r].decimated(bank.scenes[r].motion.q[k]) for r in bank.alone])[kept]
    places = int(np.ceil(_PLACES * most))
    at = np.clip((q - lower) / length * places, 0, places - 1).astype(int)
    sums = np.bincount(at, weights=e, minlength=places)
    power = np.abs(np.fft.rfft(sums, _FINE * places))[first:last]
    return 2 * np.pi * (first + int(np.argmax(power))) / (length * _FINE), last - first


def _columns(bank: Bank, r: int, k: int, wave: float) -> Array:
    """White kept rows (2 x N) of cosine and sine along the range."""
    angle = wave * bank.scenes[r].motion.q[k]
    return bank.whitened(r, k, bank.runs[r].decimated(np.stack([np.cos(angle), np.sin(angle)])))
