"""Joints whose torque oscillates by itself, at one frequency: most of what differs between the periods of a motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array
from identification.diagnosis.runs.phases import between_periods
from identification.diagnosis.search.loop import Search

#: Times that it comes at least in the rows of all periods but one, which the others tell: what is slower is a drift.
_COMES = 1.0
#: Part of what differs between periods that one oscillation must be; and that it must be where it comes less than
#: ``_QUICK`` times in those rows: noise that stays for a time looks like it.
_MOST, _SLOW, _QUICK = 0.5, 0.75, 6
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
        spectra: list[tuple[Array, Array]] = []
        total, quick = 0.0, 0.0
        for r, run in enumerate(bank.runs):
            kept = run.kept[k]
            if not run.period or int(kept.sum()) < _FEWEST:
                continue
            e = between_periods(bank.residual(r, k, weights, white=False), kept, run.period)
            e = np.where(kept, e, 0.0)
            once = run.rate / (int(kept.sum()) * (1 - 1 / run.times))
            spectra.append(lines(e, kept, run.rate, _COMES * once))
            total += float(e @ e)
            quick = max(quick, _QUICK * once)
        if not total:
            continue
        frequency = max((one for one, _ in spectra), key=len)
        part = np.sum([np.interp(frequency, *one, left=0.0, right=0.0) for one in spectra], axis=0) / total
        least_part = np.where(frequency < quick, _SLOW, _MOST)
        most = int(np.argmax(part / least_part))
        if part[most] > least_part[most]:
            result[k] = Tone(float(frequency[most]), float(part[most]))
    return result


def lines(e: Array, kept: NDArray[np.bool_], rate: float, least: float) -> tuple[Array, Array]:
    """Frequencies [Hz] from the ``least`` on and the squares of rows e (N), zero where they are not ``kept``, that an
    oscillation of each takes away.

    With c and s the products of e with cosine and sine, and C, S and D those of these with themselves and each other
    over the kept rows, which differ where joints rest: (S c^2 - 2 D c s + C s^2) / (C S - D^2).
    """
    count, rows = _FINE * len(e), int(kept.sum())
    frequency = np.fft.rfftfreq(count, 1 / rate)
    # At half the rate, which rounding puts on either side of it, a sine has no rows.
    inside = np.flatnonzero(frequency[: count // 2] >= least)
    products, twice = np.fft.rfft(e, count)[inside], np.fft.fft(kept, count)[2 * inside % count]
    c, s = products.real, -products.imag
    C, S, D = (rows + twice.real) / 2, (rows - twice.real) / 2, -twice.imag / 2
    return np.asarray(frequency[inside]), (S * c**2 - 2 * D * c * s + C * s**2) / (C * S - D**2)
