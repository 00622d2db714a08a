"""Whether recorded torques hold what a drive train's swing explains.

A swing takes from the model's torque what the motor does not feel of the link's inertia. So it takes, in any run, what
noise of the positions makes of that inertia, and of runs that do not repeat that noise is not known. A swing is heard
in the recorded torque too, whose noise is another one: the part of its power that is coherent with it tells the two
apart (Bendat and Piersol, Random Data, 2010).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.signal import csd, welch

from identification.diagnosis.columns.bank import Bank, Variant
from identification.diagnosis.columns.hypothesis import ELASTIC

Array = NDArray[np.float64]

#: Least part of a swing's power that is heard, and size of a swing, in parts of the noise's rms, from which it must be.
_HEARD, _LOUD = 0.15, 2.0
#: Most and least rows of the stretches over which spectra are averaged, and how many of them there are at least.
_LONG, _SHORT, _LEAST = 64, 16, 10


def heard(bank: Bank, runs: Sequence[int], variant: Variant, x: Array) -> bool:
    """Whether the torque of coefficients ``x`` (k) of a variant is heard along ``runs``. It is not asked where a run
    repeats, nor of what is no drive train's, or is hardly louder than the noise.
    """
    if variant.hypothesis.kind != ELASTIC or len(bank.alone) < len(bank.runs):
        return True
    k = bank.robot.numbers.index(variant.hypothesis.joint)
    coherent = power = square = rows = 0.0
    for r in runs:
        swing = x @ bank.columns(r, k, variant.columns)
        mine, recorded = bank.whitened(r, k, np.stack([swing, bank.runs[r].tau[k]]))
        stretch = min(_LONG, len(mine) // _LEAST)
        if stretch < _SHORT:
            continue
        common = np.abs(csd(mine, recorded, nperseg=stretch)[1]) ** 2
        own, whole = (welch(rows, nperseg=stretch)[1] for rows in (mine, recorded))
        square, rows = square + float(mine @ mine), rows + len(mine)
        coherent += float(np.sum(common / np.maximum(whole, np.finfo(float).tiny)))
        power += float(np.sum(own))
    return square < _LOUD**2 * rows or coherent >= _HEARD * power
