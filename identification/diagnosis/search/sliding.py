"""Friction that slides before it slips takes the place of Coulomb friction: of no more than there is."""

from __future__ import annotations

from collections.abc import Sequence

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import SINCE_REVERSAL
from identification.diagnosis.search.weighing import Weighing

#: Coulomb friction beside it, in parts of its own, below zero, from which it stands for something else: both are nearly
#: the same once it slips, and large ones that differ make up any friction of low speeds.
_BELOW = 0.25


def replaces(weighing: Weighing, variant: Variant, others: Sequence[Variant]) -> bool:
    """Whether a variant beside ``others`` leaves no less than no Coulomb friction on its joint, if it slides at all."""
    hypothesis, base = variant.hypothesis, weighing.bank.base
    coulomb = f"Fc{hypothesis.joint}"
    # Without its first coefficient nothing stands in the place of friction.
    if hypothesis.variable != SINCE_REVERSAL or coulomb not in base or 0 not in variant.used:
        return True
    values, _ = weighing.fitted([variant, *others])
    return bool(values[base.index(coulomb)] >= -_BELOW * abs(values[len(base)]))
