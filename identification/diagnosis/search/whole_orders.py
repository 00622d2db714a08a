"""Whole orders of a ripple: whether the runs say that the order is the whole number, or may lie beside it.

A gear's waves, poles and pins are counted. Before the runs are seen a whole number is more likely than all that lies
between two of them together; what they say of the order then decides by Bayes' rule.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import erf, exp, inf, pi, sqrt

import numpy as np

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import ShapeRange
from identification.diagnosis.columns.normal_equations import inverse
from identification.diagnosis.search.refinement import tangent
from identification.diagnosis.search.weighing import Weighing

#: How much more likely a whole number is than all between two of them, before the runs are seen.
_ODDS = 10.0
#: Odds below which the runs leave it open whether the order is the whole number.
UNSURE = 50.0
#: Largest difference from a whole number by which columns are differentiated, and the part of them that it changes.
_BESIDE, _CHANGED = 0.02, 0.1
#: Part of what a ripple explains that an order beside its own explains by chance, since no law is exact: a ripple is
#: not as strong all along a run.
_IMPERFECT = 3e-5
#: What of the rank another whole number must gain.
_GAIN = 0.5


@dataclass(frozen=True)
class _Order:
    """Where the best order lies beside a whole one, its standard deviation, and what it explains more."""

    step: float
    std: float
    drop: float

    def odds(self, wider: float) -> float:
        """Of the whole number against all that lies within half of one from it; noise alone would leave a variance of
        the order that is less by the factor ``wider``.
        """
        if not self.std:
            return inf
        std = self.std * sqrt(wider)
        lower, upper = ((side - self.step) / std for side in (-0.5, 0.5))
        within = (erf(upper / sqrt(2)) - erf(lower / sqrt(2))) / 2
        return _ODDS * exp(-self.drop / wider / 2) / (std * sqrt(2 * pi) * within) if within else 0.0


def odds(weighing: Weighing, variant: Variant, others: Sequence[Variant]) -> float:
    """Of the whole orders of a variant beside ``others``; infinite where it has none."""
    found = [_beside(weighing, variant, one, others) for one in _exact(variant)]
    known = [one for one in found if one is not None]
    wider = 1 + _IMPERFECT * weighing.of(variant, others).drop if known else 1.0
    return min((one.odds(wider) for one in known), default=inf)


def nearest(weighing: Weighing, variant: Variant, others: Sequence[Variant]) -> Variant:
    """The variant with the whole orders that explain most beside ``others``, near its own."""
    exact = _exact(variant)
    if not exact:
        return variant
    best = weighing.of(variant, others)
    for shape in exact:
        while (found := _beside(weighing, best.variant, shape, others)) is not None and round(found.step):
            order = max(best.variant.shape[shape.name] + round(found.step), shape.low)
            moved = weighing.bank.add(variant.hypothesis, {**best.variant.shape, shape.name: order})
            if moved is None:
                break
            weighing.refresh()
            again = weighing.of(moved.only(best.variant.used), others)
            if again.score <= best.score + _GAIN:
                break
            best = again
    return best.variant


def _exact(variant: Variant) -> list[ShapeRange]:
    return [one for one in variant.hypothesis.shapes if one.exact]


def _beside(weighing: Weighing, variant: Variant, shape: ShapeRange, others: Sequence[Variant]) -> _Order | None:
    """None where the order cannot be moved."""
    difference = _difference(weighing, variant, shape)
    beside = {**variant.shape, shape.name: variant.shape[shape.name] + difference}
    moved = weighing.bank.add(variant.hypothesis, beside, offered=False)
    if moved is None:
        return None
    weighing.refresh()
    A, b = tangent(weighing, variant, [(moved.only(variant.used), difference)], others)
    k = len(b) - 1
    C = inverse(A, 1e-9)
    with_step, without = (float(y @ G @ y) for G, y in ((C, b), (inverse(A[:k, :k], 1e-9), b[:k])))
    return _Order(float((C @ b)[k]), float(np.sqrt(C[k, k])), with_step - without)


def _difference(weighing: Weighing, variant: Variant, shape: ShapeRange) -> float:
    """Small enough for a derivative: an order of the motor's turns counts many of them."""
    columns, difference = variant.hypothesis.columns, _BESIDE
    for scene in weighing.bank.scenes:
        here = columns(scene, variant.shape)
        size = float(np.linalg.norm(here))
        while size:
            moved = columns(scene, {**variant.shape, shape.name: variant.shape[shape.name] + difference})
            if float(np.linalg.norm(moved - here)) <= _CHANGED * size:
                break
            difference /= 4
    return difference
