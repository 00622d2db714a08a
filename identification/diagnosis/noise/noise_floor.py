"""What noise alone leaves of a run that was not looked at, from the noise that was measured on the others; and where
that is so much that it is hardly noise.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from generator.words import listed
from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.runs.prepared import joined

#: Points of the integral over the frequency.
_POINTS = 400
#: Part of the torque's spread from which noise is more than a sensor's; on a joint where it is several times the part
#: that it is on most joints.
_LOUD, _LOUDER, _TIMES = 0.1, 0.02, 3.0


def density(bank: Bank, k: int, frequency: Array) -> Array:
    """One-sided power density (F) [unit^2/Hz] of coordinate k's noise at frequencies (F) [Hz], mean of all runs:
    beyond half the rate of a run's rows as strong as there.
    """
    every = []
    for run, colours in zip(bank.runs, bank.colours, strict=True):
        every.append(colours[k].spectrum(np.minimum(frequency, run.rate / 2), run.rate))
    return np.asarray(np.mean(every, axis=0))


def noise_floor(bank: Bank, k: int, rate: float) -> float:
    """Root mean square [N m, N] of the noise of coordinate k in rows at ``rate`` [Hz], those of the diagnosis."""
    frequency = np.linspace(0.0, rate / 2, _POINTS)
    return float(np.sqrt(np.trapezoid(density(bank, k, frequency), frequency)))


def notes(bank: Bank, aside: Collection[int] = ()) -> list[str]:
    """What is to be told of joints on which much counts as noise: whatever it is, nothing else was looked for in it.

    Of coordinates ``aside`` it is known what it is.
    """
    parts = {}
    for k, joint in enumerate(bank.robot.moving):
        tau = joined(bank.runs, [run.tau for run in bank.runs], k)
        if k not in aside and len(tau) and np.ptp(tau):
            parts[joint.number] = noise_floor(bank, k, bank.runs[0].rate) / float(np.std(tau))
    least = min(_LOUD, max(_LOUDER, _TIMES * float(np.median([*parts.values()])))) if len(parts) > 2 else _LOUD
    loud = [f"{100 * part:.0f} % on joint {number}" for number, part in parts.items() if part > least]
    if not loud:
        return []
    return [
        f"more of the torques' spread counts as noise than is usual, {listed(loud)}: it repeats with no period and "
        "follows from no column of the search"
    ]
