"""What noise alone leaves of a run that was not looked at, from the noise that was measured on the others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.bank import Bank

Array = NDArray[np.float64]

#: Points of the integral over the frequency.
_POINTS = 400


def density(bank: Bank, k: int, frequency: Array) -> Array:
    """One-sided power density [unit^2/Hz] of the noise of coordinate k at frequencies [Hz], mean of all runs."""
    every = []
    for run, colours in zip(bank.runs, bank.colours, strict=True):
        rate = 1 / (run.sampled.run.period * run.sampled.filters.factor)
        every.append(colours[k].spectrum(frequency, rate))
    return np.asarray(np.mean(every, axis=0))


def noise_floor(bank: Bank, k: int, rate: float) -> float:
    """Root mean square [N m, N] of the noise of coordinate k in rows at ``rate`` [Hz], those of the diagnosis."""
    frequency = np.linspace(0.0, rate / 2, _POINTS)
    return float(np.sqrt(np.trapezoid(density(bank, k, frequency), frequency)))
