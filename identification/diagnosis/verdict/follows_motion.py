"""What is left of a joint that follows its motion by no law of the library, where nothing repeats.

Where rows are few the maps of the motion are not taken away to measure the noise, which then holds what follows them.
One map at a time, held against what it leaves, tells of it all the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import f

from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.maps import groups
from identification.diagnosis.noise.may_act import maps_taken
from identification.diagnosis.verdict.lack_of_fit import CHANCE, Lack

Array = NDArray[np.float64]

#: Rows for each column of a map, at least.
_ROWS = 5


def following(bank: Bank, residuals: Sequence[Array], maps: Sequence[Sequence[Array]], k: int, lack: Lack) -> Lack:
    """The ``lack`` of coordinate k, or where more than chance of its white ``residuals`` (kept rows, one a run) follows
    one of its ``maps`` (by joint and run, m x rows), that; the first where periods were compared or maps taken out of
    the noise.
    """
    if lack.repeats or not maps or maps_taken(bank, maps, k):
        return lack
    alone = [r for r, run in enumerate(bank.runs) if not run.period]
    e = np.concatenate([residuals[r] for r in alone])
    white = [bank.colours[r][k].white(maps[k][r], bank.runs[r].kept[k]) for r in alone]
    X = np.concatenate(white, axis=1)
    each = groups(bank.robot.numbers, k)
    found = [_follows(X[part], e, what, lack, len(each)) for what, part in each.items()]
    return max((one for one in found if one.p < CHANCE), key=lambda one: one.size, default=lack)


def _follows(X: Array, e: Array, what: str, lack: Lack, tried: int) -> Lack:
    """How much of e is a sum of the rows of X (m x N), beyond what as many rows of noise are: an F test.

    The size is that of all that the joint lacks, if its power says so too.
    """
    _, s, V = np.linalg.svd(X, full_matrices=False)
    V = V[s > 1e-6 * s.max(initial=0.0)]
    free = len(e) - len(V)
    if not len(V) or len(e) < _ROWS * len(V):
        return replace(lack, p=1.0)
    explained = float(np.sum((V @ e) ** 2))
    left = float(e @ e) - explained
    ratio = (explained / len(V)) / max(left / free, 1e-300)
    p = min(1.0, tried * float(f.sf(ratio, len(V), free)))
    size = float(np.sqrt(max(ratio - 1, 0.0) * len(V) / len(e)))
    size = max(size, lack.size) if lack.p < CHANCE else size
    return Lack(lack.joint, ratio, p, size, False, lack.burst, follows=what)
