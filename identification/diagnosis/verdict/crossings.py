"""What the model leaves while no link crosses its gap: which way one bounces there the smallest error changes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.ndimage import maximum_filter1d

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.lack_of_fit import CHANCE, lack_of_fit

#: Torque of a backlash, in parts of the noise's rms, from which its link crosses, and the time [s] before and after.
_CROSSES, _ABOUT = 0.5, 0.05
#: Least part of the rows that must be left.
_ENOUGH = 0.25


def left_between(found: Search, backlash: Variant) -> dict[int, float]:
    """By the number of each joint that a ``backlash`` which was found reaches, what stays beyond chance beside the
    noise's rms on rows between the crossings; without joints of which too few are between them.
    """
    bank, result = found.bank, {}
    weights = {number: found.weights[number] for number in backlash.columns}
    for k in backlash.joints:
        quiet, left, rows = [], [], 0
        for r, run in enumerate(bank.runs):
            e = bank.residual(r, k, found.weights)
            crossing = np.zeros(len(run.t))
            crossing[run.kept[k]] = np.abs(bank.residual(r, k, {}) - bank.residual(r, k, weights))
            about = maximum_filter1d(crossing, 1 + 2 * round(_ABOUT * run.rate))
            kept = run.kept.copy()
            kept[k] &= about < _CROSSES
            rows += len(e)
            left.append(e[kept[k][run.kept[k]]])
            quiet.append(replace(run, kept=kept))
        if sum(map(len, left)) > _ENOUGH * rows:
            lack = lack_of_fit(quiet, left, k, bank.robot.numbers[k])
            result[lack.joint] = lack.size if lack.p < CHANCE else 0.0
    return result
