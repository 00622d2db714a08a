"""Spectra of rows with gaps, of several runs together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import signal

from identification.arrays import Array

#: Samples of a stretch at most, and the fewest of a run that counts.
_STRETCH, _FEWEST = 512, 16


@dataclass(frozen=True)
class Spectrum:
    """Amplitude density, the root of the one-sided power density [unit/sqrt(Hz)], over frequencies [Hz] without 0."""

    f: Array
    amplitude: Array


def spectrum(runs: Sequence[tuple[Array, Array, float]]) -> Spectrum | None:
    """Of runs (times [s] and values, N each, time step [s]) whose rows may be missing; None where all are too short.

    Welch's method, stretches that overlap by half under Hann's window; missing rows are zero and the density is divided
    by the part of the rows that is there (Parzen 1963). Runs count by their rows; those of another time step than the
    first run's are interpolated to its frequencies, as far as theirs go.
    """
    found = [(f, density, len(y)) for t, y, step in runs if (one := _density(t, y, step)) for f, density in [one]]
    if not found:
        return None
    f = found[0][0]
    densities = np.array([np.interp(f, own, density) for own, density, _ in found])
    weights = np.array([count * (f <= own[-1]) for own, _, count in found])
    return Spectrum(f[1:], np.sqrt(np.average(densities, axis=0, weights=weights))[1:])


def _density(t: Array, y: Array, step: float) -> tuple[Array, Array] | None:
    """Frequencies and power density of one run."""
    if len(y) < _FEWEST:
        return None
    at = np.rint((t - t[0]) / step).astype(int)
    filled = np.zeros(at[-1] + 1)
    filled[at] = y
    f, density = signal.welch(filled, 1 / step, nperseg=min(_STRETCH, len(filled)), detrend=False)
    return f, density * len(filled) / len(y)
