"""Joints whose torque ripples along their range, at one period that no finding explains.

Where nothing repeats such a ripple counts as noise: it is too fine for maps of the range.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.maps import span_of
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.f_test import f_test
from identification.diagnosis.verdict.lack_of_fit import CHANCE

#: Part of the residual's squares that a ripple must be: a third of the noise's rms. One sine of many that are tried is
#: believed less easily than one law.
_LEAST = 0.1
#: Fewest ripples along the range, which maps do not follow to the end, and waves for each that the range tells apart.
_FEWEST, _FINE = 4, 4
#: Part of half a turn by which a ripple advances from row to row, at the joint's rms speed, in the finest tried.
_ADVANCE = 0.8
#: Part of the finest wave number from which a still finer one may look like it, where speeds are all alike.
_FOLDED = 0.5
#: Places in the finest ripple between which rows are not told apart in looking for it.
_PLACES = 16


@dataclass(frozen=True)
class Ripple:
    """Its ``length`` along the range [rad, m], the ``part`` of the residual's squares that it is, and whether it may be
    a ``finer`` one that looks like it.
    """

    length: float
    part: float
    finer: bool

    @property
    def or_finer(self) -> str:
        """The same in words that follow its length; nothing where it cannot."""
        return " or finer" if self.finer else ""


@dataclass(frozen=True)
class _Waves:
    """Those that are tried: ``first`` to before ``last`` of ``_FINE`` a turn along a range from ``lower``, ``length``
    [rad, m] long.
    """

    lower: float
    length: float
    first: int
    last: int

    def __len__(self) -> int:
        return max(self.last - self.first, 0)

    def wave(self, number: int) -> float:
        """Wave number [rad/rad, rad/m]."""
        return 2 * np.pi * number / (_FINE * self.length)


def ripples(found: Search, weights: Mapping[int, float]) -> dict[int, Ripple]:
    """By coordinate, the ripple of runs that do not repeat with values of columns by number, where it is no chance."""
    bank, result = found.bank, {}
    for k in range(bank.dof):
        if not any(bank.runs[r].kept[k].any() for r in bank.alone):
            continue
        if not (waves := _tried(bank, k)):
            continue
        number = _strongest(bank, k, weights, waves)
        wave = waves.wave(number)
        e = np.concatenate([bank.residual(r, k, weights) for r in bank.alone])
        X = np.concatenate([_columns(bank, r, k, wave) for r in bank.alone], axis=1)
        one = f_test(X, e, bank.counts(k)[1])
        if len(waves) * one.p < CHANCE and one.part >= _LEAST:
            result[k] = Ripple(2 * np.pi / wave, one.part, number > _FOLDED * waves.last)
    return result


def _rows(bank: Bank, k: int, signal: Callable[[int], Array]) -> Array:
    """Kept rows of coordinate k (N) along the runs that do not repeat, of a signal by the run's number."""
    return np.concatenate([signal(r)[bank.runs[r].kept[k]] for r in bank.alone])


def _tried(bank: Bank, k: int) -> _Waves:
    """Waves along the range of coordinate k, to those that rows can follow at its usual speed."""
    motions = {r: bank.scenes[r].motion for r in bank.alone}
    lower, upper = span_of([one.q[k] for one in motions.values()])
    speed = float(np.sqrt(np.mean(_rows(bank, k, lambda r: bank.runs[r].decimated(motions[r].qd[k])) ** 2)))
    slowest = min(bank.runs[r].rate for r in bank.alone if bank.runs[r].kept[k].any())
    most = _ADVANCE * slowest * (upper - lower) / (2 * speed)
    return _Waves(lower, upper - lower, _FEWEST * _FINE, int(np.ceil(most * _FINE)))


def _strongest(bank: Bank, k: int, weights: Mapping[int, float], waves: _Waves) -> int:
    """The number of the wave of which the residual as recorded holds most: by a Fourier transform of its sums over
    places, whose size does not grow with rows times waves.
    """
    e = _rows(bank, k, lambda r: bank.residual(r, k, weights, white=False))
    q = _rows(bank, k, lambda r: bank.runs[r].decimated(bank.scenes[r].motion.q[k]))
    places = _PLACES * -(-waves.last // _FINE)
    at = np.clip((q - waves.lower) / waves.length * places, 0, places - 1).astype(int)
    sums = np.bincount(at, weights=e, minlength=places)
    power = np.abs(np.fft.rfft(sums, _FINE * places))[waves.first : waves.last]
    return waves.first + int(np.argmax(power))


def _columns(bank: Bank, r: int, k: int, wave: float) -> Array:
    """White kept rows (2 x N) of cosine and sine along the range."""
    angle = wave * bank.scenes[r].motion.q[k]
    return bank.whitened(r, k, bank.runs[r].decimated(np.stack([np.cos(angle), np.sin(angle)])))
