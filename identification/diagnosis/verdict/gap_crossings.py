"""What the model leaves while no link crosses its gap: which way one bounces there the smallest error changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from scipy.ndimage import maximum_filter1d

from identification.diagnosis.search.evidence import Evidence
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.lack_of_fit import lack_of_fit
from identification.diagnosis.verdict.of_rounding import of_rounding

#: What may be left where a link bounces in a gap, in parts of what was explained.
BOUNCED = 0.7
#: White torque of a backlash, in parts of the noise's rms, from which its link crosses, and the time [s] before and
#: after.
_CROSSES, _ABOUT = 0.5, 0.05
#: Least part of the rows that must be left.
_ENOUGH = 0.4


def left_between(found: Search, backlash: Evidence, left: Mapping[int, float]) -> dict[int, float]:
    """What is ``left`` on joints, by number, beside the noise's rms: of those that a ``backlash`` which was found
    reaches, on rows between its crossings, if it explains most of what these leave.

    On a joint of which too few rows are between them, or on which no periods are compared, all rows count: only
    repetition tells noise there from what is left.
    """
    bank, values, result = found.bank, found.weights, dict(left)
    own = {number: values[number] for number in backlash.variant.columns}
    for k, size in backlash.sizes.items():
        number = bank.robot.numbers[k]
        if not 0 < left.get(number, 0.0) <= BOUNCED * size:
            continue
        quiet, rest, rows = [], [], 0
        for r, run in enumerate(bank.runs):
            white = bank.residual(r, k, values)
            crossing = np.zeros(len(run.t))
            crossing[run.kept[k]] = np.abs(bank.residual(r, k, {}) - bank.residual(r, k, own))
            kept = run.kept.copy()
            kept[k] &= maximum_filter1d(crossing, 1 + 2 * round(_ABOUT * run.rate)) < _CROSSES
            rows += len(white)
            rest.append(white[kept[k][run.kept[k]]])
            quiet.append(replace(run, kept=kept))
        if sum(map(len, rest)) > _ENOUGH * rows:
            lack = lack_of_fit(quiet, rest, k, number, rounded=of_rounding(found, k, range(len(bank.runs))))
            if lack.repeats:
                result[number] = lack.size if lack.told else 0.0
    return result
