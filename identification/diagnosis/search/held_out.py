"""What runs say that were not fitted: how much better the others predict them with a hypothesis than without.

The gain of a run is what all runs together lose of the sum of squares with the hypothesis, beyond what the others lose
without this one. Where those leave parameters uncertain a prediction is uncertain too, and its error counts less.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank, Variant
from identification.diagnosis.columns.normal_equations import (
    Prior,
    inverse,
    least_part,
    lowered,
    square,
    told_apart,
    without,
)


class HeldOut:
    """Predictions of the runs ``validate`` of a bank from its runs ``train``; of each of these in turn without any."""

    def __init__(self, bank: Bank, train: Sequence[int], validate: Sequence[int], prior: Prior | None) -> None:
        self._bank, self._prior = bank, prior
        fitted, all_ = tuple(train), (*train, *validate)
        #: Runs that predict, and those with what is predicted.
        self._turns = [(fitted, all_)]
        if not validate:
            self._turns = [(tuple(one for one in fitted if one != out), fitted) for out in fitted]
        self._inverses: dict[tuple[tuple[int, ...], tuple[int, ...]], Array] = {}

    def gain(self, variant: Variant, coefficients: Array, chosen: Sequence[int]) -> tuple[float, float]:
        """Drop of the predicted runs' sum of squares with a variant beside the columns ``chosen``, and what it would be
        if the variant acts with these coefficients.
        """
        gained = promised = 0.0
        for fewer, more in self._turns:
            whole, least = self._part(more, variant, chosen)
            part, _ = self._part(fewer, variant, chosen)
            x, drop = variant.best(whole[:-1, :-1], whole[:-1, -1], least)
            gained += drop - _drop(part, x, variant.preset is not None)
            promised += float(coefficients @ (whole - part)[:-1, :-1] @ coefficients)
        return gained, promised

    def _part(self, runs: tuple[int, ...], variant: Variant, chosen: Sequence[int]) -> tuple[Array, Array]:
        """What is left beside ``chosen`` of the products of the variant's columns and the torque over some runs, fitted
        by themselves; and what of the squares of the whole columns must be.
        """
        beside, known, values = told_apart([*range(len(self._bank.base)), *chosen], self._bank.preset)
        at = [*known.tolist(), *variant.columns, self._bank.count]
        across, own = self._products(runs, beside.tolist(), at), self._products(runs, at, at)
        part = own - across.T @ self._inverse(runs, beside.tolist()) @ across
        left = without(part, np.arange(len(known)), values)[len(known) :, len(known) :]
        return left, least_part(self._prior) * own.diagonal()[len(known) : -1]

    def _inverse(self, runs: tuple[int, ...], columns: Sequence[int]) -> Array:
        key = (runs, tuple(columns))
        if key not in self._inverses:
            self._inverses[key] = inverse(self._products(runs, columns, columns))
        return self._inverses[key]

    def _products(self, runs: Sequence[int], rows: Sequence[int], columns: Sequence[int]) -> Array:
        """Products of columns over some runs, with what is known of the base parameters beforehand."""
        at = np.ix_(np.array(rows), np.array(columns))
        result = np.sum([self._bank.grams[r][at] for r in runs], axis=0)
        if self._prior is not None:
            result = result + self._prior.products(rows, columns, self._bank.count)
        return np.asarray(result)


def _drop(part: Array, x: Array, preset: bool) -> float:
    """What the columns lower the sum of squares by that coefficients x of all runs together use: others would be
    another model. Those that are ``preset`` are x here too.
    """
    if preset:
        return lowered(part[:-1, :-1], part[:-1, -1], x)
    used = np.flatnonzero(x)
    b = part[used, -1]
    return float(b @ inverse(square(part, used)) @ b)
