"""Rarer friction beside common friction that was found: where more is left than it explains, it may be a part of it."""

from __future__ import annotations

from collections.abc import Sequence

from identification.diagnosis.columns.bank import Bank, Variant, columns_of
from identification.diagnosis.columns.normal_equations import Normal
from identification.diagnosis.search.imperfect_laws import OF_SPEED
from identification.diagnosis.search.likely import common

#: Part of the noise's power from which what is left of a joint counts: where no motion repeats, the noise is not known
#: apart from it.
_TOLD = 0.25


def adds(variant: Variant, others: Sequence[Variant]) -> bool:
    """Whether a variant is not common, shows over the speed, and adds to common friction among ``others`` on each of
    its joints.
    """
    found = {one.coordinates for one in others if common(one) and _over_speed(one)}
    return _over_speed(variant) and not common(variant) and all((k,) in found for k in variant.coordinates)


def left(bank: Bank, normal: Normal, runs: Sequence[int], variant: Variant, others: Sequence[Variant]) -> float:
    """The sum of squares beyond the noise's that a variant and ``others``, fitted by ``normal`` equations of some runs,
    leave of its joints, without what may be noise.
    """
    weights = normal.by_number(columns_of([*others, variant]))
    result = 0.0
    for k in variant.coordinates:
        square, rows = bank.left_over(k, weights, runs)
        beyond = square - rows
        result += beyond if beyond > _TOLD * rows else 0.0
    return result


def _over_speed(variant: Variant) -> bool:
    return variant.hypothesis.variable in OF_SPEED
