"""What the runs that test say of each finding: they choose nothing, but what they contradict is taken back.

The model with a finding and the one without it, both fitted to the other runs, predict torques of the testing runs that
differ by d, in units of the noise. Where the finding is true the sum of squares falls by |d|^2 with it, where it is not
it rises as much, each with a standard deviation of 2 |d|.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.bank import Bank, Variant
from identification.diagnosis.loop import Search
from identification.diagnosis.prepared import Prepared
from identification.diagnosis.scene import Scene
from identification.diagnosis.selection import Choice, Selection

Array = NDArray[np.float64]

#: Least |d|^2 at which the testing runs tell anything of a finding.
_TOLD = 9.0


def confirmed(found: Search, test: Sequence[Prepared]) -> tuple[Search, tuple[Choice, ...]]:
    """The search without the choices that ``test`` contradicts, and those; the most contradicted goes first.

    What passed only beside one that is taken back goes too.
    """
    if not found.choices or not test:
        return found, ()
    bank = _along(found, test)
    staying, gone = list(found.choices), []
    while staying:
        against = [(_gained(bank, found, staying, one), one) for one in staying]
        least, worst = min(against, key=lambda pair: pair[0])
        if least >= 0:
            break
        staying.remove(worst)
        gone.append(worst)
    if not gone:
        return found, ()
    again = Selection(found.weighing).choices([one.evidence.variant for one in staying])
    return found.keeping(again), tuple(gone)


def _along(found: Search, test: Sequence[Prepared]) -> Bank:
    """The base columns along the testing runs, white by the noisiest of the other runs."""
    usual = found.bank.scenes[0]
    bank = Bank(test, [Scene(run.sampled, usual.regressors, usual.values, usual.beside) for run in test])
    noisiest = [max(mine, key=lambda colour: colour.deviations[-1]) for mine in zip(*found.bank.colours, strict=True)]
    bank.whiten([noisiest for _ in test])
    return bank


def _gained(bank: Bank, found: Search, staying: Sequence[Choice], one: Choice) -> float:
    """What the testing runs' sum of squares falls by with a choice beside the others; 0 where they tell nothing."""
    without = _residuals(bank, found, [other for other in staying if other is not one])
    change = without - _residuals(bank, found, staying)
    if float(change @ change) < _TOLD:
        return 0.0
    return float(2 * without @ change - change @ change)


def _residuals(bank: Bank, found: Search, choices: Sequence[Choice]) -> Array:
    """White residuals of the testing runs by the model with ``choices``, as the other runs fit it."""
    variants = [one.evidence.variant for one in choices]
    solution, _ = found.weighing.all.solution([number for one in variants for number in one.columns])
    numbers = [*range(len(bank.base)), *(number for one in variants for number in _numbers(bank, one))]
    values = dict(zip(numbers, solution.tolist(), strict=True))
    return np.concatenate([bank.residual(r, k, values) for r in range(len(bank.runs)) for k in range(bank.dof)])


def _numbers(bank: Bank, variant: Variant) -> Sequence[int]:
    """Of a variant's columns along the testing runs; new ones, for no value, where it makes no torque there."""
    there = bank.add(variant.hypothesis, variant.shape)
    if there is None:
        return range(bank.count + 1, bank.count + 1 + len(variant.columns))
    return there.only(variant.used).columns
