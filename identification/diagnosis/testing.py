"""The runs that test, as rows on which what the other runs fitted can be held."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.bank import Bank, Variant
from identification.diagnosis.evidence import key_of
from identification.diagnosis.loop import Search
from identification.diagnosis.prepared import Prepared
from identification.diagnosis.scene import Scene
from identification.diagnosis.whitening import Colour

Array = NDArray[np.float64]

#: Noise of joints that no row of the other runs shows.
_PLAIN = Colour((np.ones(1),), (1.0,))


@dataclass(frozen=True)
class Testing:
    """White ``columns`` (c x N) of the testing runs, those of the base and of what was found, and ``torque`` (N).

    ``places`` tells the columns of each hypothesis, by its effect and joint; -1 where they make no torque.
    """

    found: Search
    columns: Array
    torque: Array
    places: dict[tuple[str, int], tuple[int, ...]]

    def fitted(self, variants: Sequence[Variant]) -> tuple[Array, Array]:
        """Values of the columns as the other runs fit them (c), 0 without a variant; their covariance (c x c)."""
        solution, covariance = self.found.weighing.all.solution([n for one in variants for n in one.columns])
        base = range(len(self.found.bank.base))
        at = np.array([*base, *(self.places[key_of(one)][i] for one in variants for i in one.used)])
        acts = at >= 0
        theta, C = np.zeros(len(self.columns)), np.zeros((len(self.columns),) * 2)
        theta[at[acts]] = solution[acts]
        C[np.ix_(at[acts], at[acts])] = covariance[np.ix_(acts, acts)]
        return theta, C

    def left(self, theta: Array) -> Array:
        """White torque (N) that values of the columns leave unexplained."""
        return np.asarray(self.torque - theta @ self.columns)


def along(found: Search, test: Sequence[Prepared]) -> Testing | None:
    """Joints that the other runs show, white by the noisiest of them.

    None without runs or findings, and where what was found is impossible along a run: a testing run may lack what the
    others have, such as a temperature.
    """
    if not (found.choices and test):
        return None
    usual = found.bank.scenes[0]
    bank = Bank(test, [Scene(run.sampled, usual.regressors, usual.values, usual.beside) for run in test])
    shown = np.sum([found.bank.rows(r) for r in (*found.train, *found.validate)], axis=0) > 0
    noisiest = [
        max(mine, key=lambda one: one.deviations[-1]) if seen else _PLAIN
        for mine, seen in zip(zip(*found.bank.colours, strict=True), shown, strict=True)
    ]
    places: dict[tuple[str, int], tuple[int, ...]] = {}
    for one in found.choices:
        variant = one.evidence.variant
        there = bank.add(variant.hypothesis, variant.shape)
        if there is None and key_of(variant) not in bank.nowhere:
            return None
        places[key_of(variant)] = there.columns if there else (-1,) * len(variant.hypothesis.coefficients)
    bank.whiten([noisiest for _ in test])
    blocks = [np.empty((bank.count + 1, 0))]
    for r in range(len(test)):
        for k in np.flatnonzero(shown):
            numbers, white = bank.white(r, int(k))
            block = np.zeros((bank.count + 1, white.shape[1]))
            block[[*numbers, bank.count]] = white
            blocks.append(block)
    rows = np.concatenate(blocks, axis=1)
    return Testing(found, rows[:-1], rows[-1], places)
