"""Joints whose torque oscillates by itself, at one frequency: most of what differs between the periods of a motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.noise.measured import between_periods
from identification.diagnosis.search.loop import Search

Array = NDArray[np.float64]

#: Part of what differs between periods that one oscillation must be; and that one must be which comes less than so
#: often in a period: noise that stays for seconds looks like it.
_MOST, _SLOW, _QUICK = 0.5, 0.75, 2
#: Times in a run that it comes at least: what is slower is a drift.
_COMES = 1.5
#: Frequencies that are looked at, for each that a run's rows tell apart.
_FINE = 4
#: Fewest rows of a run.
_FEWEST = 100


@dataclass(frozen=True)
class Tone:
    """Its ``frequency`` [Hz] and the ``part`` of what differs between periods that it is, in squares."""

    frequency: float
    part: float


def tones(found: Search, weights: Mapping[int, float]) -> dict[int, Tone]:
    """By coordinate, the oscillation that is most of what differs between periods with values of columns by number."""
    result, bank = {}, found.bank
    for k in range(bank.dof):
        lines: list[tuple[Array, Array]] = []
        total, quick = 0.0, 0.0
        for r, run in enumerate(bank.runs):
            kept = run.kept[k]
            if not run.period or int(kept.sum()) < _FEWEST:
                continue
            e = between_periods(bank.residual(r, k, weights, white=False), kept, run.period)
            e = np.where(kept, e, 0.0)
            lines.append(_lines(e, int(kept.sum()), run.rate, _COMES * run.rate / len(e)))
            total += float(e @ e)
            quick = max(quick, _QUICK * run.rate / run.period)
        if not total:
            continue
        frequency = max((one for one, _ in lines), key=len)
        power = np.sum([np.interp(frequency, *one, left=0.0) for one in lines], axis=0)
        at = int(np.argmax(power / np.where(frequency < quick, _SLOW, _MOST)))
        one = Tone(float(frequency[at]), float(power[at]) / total)
        if one.part > (_SLOW if one.frequency < quick else _MOST):
            result[k] = one
    return result


def _lines(e: Array, rows: int, rate: float, least: float) -> tuple[Array, Array]:
    """Frequencies [Hz] from the ``least`` on and the squares of rows e (N), ``rows`` of them not zero, that an
    oscillation of each takes away.
    """
    count = _FINE * len(e)
    frequency = np.fft.rfftfreq(count, 1 / rate)
    inside = (frequency >= least) & (frequency < rate / 2)
    return np.asarray(frequency[inside]), 2 / rows * np.abs(np.fft.rfft(e, count)[inside]) ** 2
