"""What is left of a joint that follows its motion by no law of the library, where nothing repeats.

Where rows are few the maps of the motion are not taken away to measure the noise, which then holds what follows them.
One map at a time, held against what it leaves, tells of it all the same.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.maps import groups
from identification.diagnosis.noise.may_act import maps_taken
from identification.diagnosis.verdict.f_test import FTest, f_test
from identification.diagnosis.verdict.lack_of_fit import CHANCE, Lack


def following(bank: Bank, residuals: Sequence[Array], maps: Sequence[Sequence[Array]], k: int, lack: Lack) -> Lack:
    """The ``lack`` of coordinate k, or where more than chance of its white ``residuals`` (kept rows, one a run) follows
    one of its ``maps`` (by joint and run, m x rows), that; the first where periods were compared or maps taken out of
    the noise.
    """
    if lack.repeats or not maps or maps_taken(bank, maps, k):
        return lack
    e = np.concatenate([residuals[r] for r in bank.alone])
    if not len(e):
        return lack
    X = np.concatenate([bank.whitened(r, k, maps[k][r]) for r in bank.alone], axis=1)
    each = groups(bank.robot.numbers, k)
    _, fitted = bank.counts(k)
    found = [_follows(f_test(X[part], e, fitted), len(e), what, lack, len(each)) for what, part in each.items()]
    return max((one for one in found if one.p < CHANCE), key=lambda one: one.size, default=lack)


def _follows(one: FTest, rows: int, what: str, lack: Lack, tried: int) -> Lack:
    """How much of the residual's ``rows`` follows ``what``, one of so many ``tried``.

    The size is that of all that the joint lacks, if its power says so too.
    """
    size = float(np.sqrt(max(one.ratio - 1, 0.0) * one.rank / rows))
    size = max(size, lack.size) if lack.p < CHANCE else size
    return Lack(lack.joint, one.ratio, min(1.0, tried * one.p), size, False, lack.burst, follows=what)
