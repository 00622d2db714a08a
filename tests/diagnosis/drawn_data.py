"""Three runs of drawn columns, of which two are fitted and one validates, and a search in them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.search.selection import Choice, Selection
from identification.diagnosis.search.weighing import Weighing
from tests.matrices import bank, hypothesis, run, whitened

Array = NDArray[np.float64]

#: Two runs are fitted, one validates.
RUNS, COUNT = 3, 1500
TRAIN, VALIDATE = (0, 1), (2,)


class Data:
    """Base columns, as many columns as wanted, and noise of deviation 1, all drawn."""

    def __init__(self, seed: int) -> None:
        self.draw = np.random.default_rng(seed)
        self.base = self.draw.normal(size=(RUNS, 3, COUNT))
        self.noise = self.draw.normal(size=(RUNS, COUNT))

    def column(self) -> Array:
        """One of rms 1 in every run (RUNS x COUNT)."""
        return self.draw.normal(size=(RUNS, COUNT))

    def bank(self, effect: Array | float, offered: Sequence[Hypothesis]) -> Bank:
        """Runs with an effect, and columns of the hypotheses with all their shapes."""
        tau = np.einsum("rpn,p->rn", self.base, [3.0, -1.0, 0.5]) + effect + self.noise
        one = bank([run(W, y) for W, y in zip(self.base, tau, strict=True)])
        for each in offered:
            for shape in each.variants:
                one.add(each, shape)
        return whitened(one)


def fixed(name: str, column: Array, bounds: tuple[float | None, float | None] = (None, None)) -> Hypothesis:
    return hypothesis(name, lambda r, shape: column[r], bounds=bounds)


def search(one: Bank) -> list[Choice]:
    return Selection(Weighing(one, TRAIN, VALIDATE, None)).search()


def names(found: Sequence[Choice]) -> set[str]:
    return {one.evidence.variant.hypothesis.effect for one in found}
