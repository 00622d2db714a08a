"""Whether one amplitude of a finding holds: in all runs, and from the beginning to the end of runs that repeat.

Where a motion repeats, an effect that is what its name says makes the same torque in every period. One that grows or
fades there is another, or drifts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank, Variant
from identification.diagnosis.columns.hypothesis import Key
from identification.diagnosis.search.loop import Search

BETWEEN, ALONG = "differs between the runs", "changes from the beginning of a run to its end"
#: Part of an effect by which its amplitude may wander, as laws do, and standard deviations that are chance.
_WANDERS, _CHANCE = 0.25, 4.0
#: Power of an effect, in parts of the noise's of one row, below which its amplitude is not known.
_TOLD = 1.0


def disagreements(found: Search) -> dict[Key, str]:
    """How the runs disagree on the amplitude of findings, in words, by effect and joint; none where they agree.

    Periods are compared by their number, over all runs that repeat.
    """
    variants, weights, runs = found.variants, found.weights, (*found.train, *found.validate)
    each = {one.key: [_periods(found.bank, r, one, weights) for r in runs] for one in variants}
    return {key: how for key, runs in each.items() if (how := _disagreement(runs))}


def _disagreement(runs: Sequence[Array]) -> str:
    """Of the powers and products (2 x P) in the periods of each run."""
    if not _agree(np.array([run.sum(axis=1) for run in runs])):
        return BETWEEN
    periods = np.zeros((max(run.shape[1] for run in runs), 2))
    for power, product in (run for run in runs if run.shape[1] > 1):
        own = product.sum() / max(power.sum(), _TOLD)
        periods[: len(power)] += np.stack([power, product - own * power], axis=-1)
    return "" if _agree(periods) else ALONG


def _agree(parts: Array) -> bool:
    """Whether no part's amplitude is off the mean, and none off another, by more than chance and what laws wander.

    ``parts`` (P x 2) hold the power of an effect and its product with what is left, both white: the amplitude is one
    and the product over the power, with a variance of one over the power.
    """
    power, product = parts[parts[:, 0] > _TOLD].T
    if len(power) < 2:
        return True
    amplitude, variance = product / power, 1 / power
    off = np.abs(amplitude - product.sum() / power.sum())
    apart = np.abs(np.subtract.outer(amplitude, amplitude))
    one = off < _CHANCE * np.sqrt(variance) + _WANDERS
    two = apart < _CHANCE * np.sqrt(np.add.outer(variance, variance)) + 2 * _WANDERS
    return bool(one.all() and two.all())


def _periods(bank: Bank, r: int, variant: Variant, weights: Mapping[int, float]) -> Array:
    """Power and product (2 x P) in the periods of a run, which is one of them where it does not repeat."""
    run = bank.runs[r]
    rows = np.arange(len(run.t))
    period = rows // run.period if run.period else 0 * rows
    result = np.zeros((2, int(period[-1]) + 1))
    for k in variant.coordinates:
        numbers, white = bank.white(r, k)
        effect = np.sum([weights[column] * white[numbers.index(column)] for column in variant.columns], axis=0)
        for row, other in zip(result, (effect, bank.residual(r, k, weights)), strict=True):
            row += np.bincount(period[run.kept[k]], effect * other, len(row))
    return result
