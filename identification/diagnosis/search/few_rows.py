"""Joints of which the runs have too few rows for what is known to act there: they do not tell noise from the model.

What is small there is not taken from the first: a model with much of it no longer tells what is large.
"""

from __future__ import annotations

from collections.abc import Mapping

from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.noise.may_act import enough
from identification.diagnosis.search.evidence import Evidence
from identification.diagnosis.search.likely import common

#: Size of an effect where it is largest, in parts of the noise's rms, from which it is named on such a joint.
LEAST = 0.75

#: Rows in all runs and number of base parameters that act, by coordinates of which the rows are too few.
Few = Mapping[int, tuple[int, int]]


def few_rows(bank: Bank) -> Few:
    """Of the joints of a bank; nothing where all have rows enough."""
    result = {}
    for k in range(bank.dof):
        rows, model = bank.counts(k)
        if rows and not enough(rows, model):
            result[k] = rows, model
    return result


def small(one: Evidence, few: Few) -> bool:
    """Whether it acts on a joint of few rows, is small beside its noise or not believed, and is neither what every
    robot has nor what another fit than that of the columns tells.
    """
    if few.keys().isdisjoint(one.variant.coordinates) or common(one.variant) or one.variant.preset is not None:
        return False
    return one.size < LEAST or not one.believed
