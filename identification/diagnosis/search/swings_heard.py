"""Whether recorded torques hold what a drive train's swing explains.

A swing takes from the model's torque what the motor does not feel of the link's inertia. So it takes, in any run, what
noise of the positions makes of that inertia, and of runs that do not repeat that noise is not known. A swing is heard
in the recorded torque too, whose noise is another one: the part of its power that is coherent with it tells the two
apart (Bendat and Piersol, Random Data, 2010).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.signal import csd

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank, Variant
from identification.diagnosis.columns.hypothesis import ELASTIC

#: Least part of a swing's power that is heard, and size of a swing, in parts of the noise's rms, from which it must be.
_HEARD, _LOUD = 0.15, 2.0
#: Most and least rows of the stretches over which spectra are averaged, and how many of them there are at least.
_LONG, _SHORT, _LEAST = 64, 16, 10


def heard(bank: Bank, runs: Sequence[int], variant: Variant, x: Array) -> bool:
    """Whether the torque of coefficients ``x`` (k) of a variant is heard along ``runs``. It is not asked where a run
    repeats, nor of what is no drive train's, is hardly louder than the noise, or has few rows in all runs.
    """
    hypothesis = variant.hypothesis
    if hypothesis.kind != ELASTIC or len(bank.alone) < len(bank.runs):
        return True
    k = bank.robot.numbers.index(hypothesis.joint)
    if k not in variant.coordinates:
        return True
    pairs = [
        bank.whitened(r, k, np.stack([x @ bank.columns(r, k, variant.columns), bank.runs[r].tau[k]])) for r in runs
    ]
    pairs = [pair for pair in pairs if pair.shape[1] >= _LEAST * _SHORT]
    rows = sum(pair.shape[1] for pair in pairs)
    if sum(float(swing @ swing) for swing, _ in pairs) < _LOUD**2 * rows or not pairs:
        return True
    stretch = min(_LONG, min(pair.shape[1] for pair in pairs) // _LEAST)
    common, own, whole = (
        np.sum([pair.shape[1] * csd(pair[i], pair[j], nperseg=stretch)[1] for pair in pairs], axis=0)
        for i, j in ((0, 1), (0, 0), (1, 1))
    )
    coherent = np.sum(np.abs(common) ** 2 / np.maximum(whole.real, np.finfo(float).tiny)) / np.sum(own.real)
    # By chance two signals have about half a stretch of all in common, as Hann windows overlap by half: twice that is
    # not beyond it.
    return bool(coherent - stretch / rows >= _HEARD)
