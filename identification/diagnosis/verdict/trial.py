"""The runs that test, as rows on which what the other runs fitted can be held."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.acting import Acting
from identification.diagnosis.columns.bank import Bank, Variant, columns_of
from identification.diagnosis.columns.normal_equations import Normal
from identification.diagnosis.columns.whitening import Colour, at_rate
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.search.loop import Search

#: Times that one run is logged faster than another from which their noise is not compared.
_UNLIKE = 1.5
#: Noise of joints that no row of the other runs shows.
_PLAIN = Colour((np.ones(1),), (1.0,))


@dataclass(frozen=True)
class Trial:
    """White ``columns`` (c x N) of the testing runs, those of the base and of what was found, and ``torque`` (N).

    ``bank`` holds these runs as recorded; ``shown`` are the coordinates that the other runs show.
    ``normal`` is of the runs that fit and validate. ``usual`` (N) is how much of the noise that a row is white by, that
    of the noisiest run, all of them have in the mean. ``places`` tells the columns of each hypothesis, by its effect
    and joint; -1 where they make no torque.
    """

    normal: Normal
    columns: Array
    torque: Array
    bank: Bank
    shown: tuple[int, ...]
    usual: Array
    places: dict[tuple[str, int], tuple[int, ...]]

    def fitted(self, variants: Sequence[Variant]) -> tuple[Array, Array]:
        """Values of the columns as the other runs fit them (c), 0 without a variant; their covariance (c x c).

        What noise of the positions takes of values is not given back: it is in the columns here too.
        """
        solution, covariance = self.normal.solution(columns_of(variants))
        base = range(self.normal.base)
        at = np.array([*base, *(self.places[one.key][i] for one in variants for i in one.used)])
        acts = at >= 0
        theta, C = np.zeros(len(self.columns)), np.zeros((len(self.columns),) * 2)
        theta[at[acts]] = solution[acts]
        C[np.ix_(at[acts], at[acts])] = covariance[np.ix_(acts, acts)]
        return theta, C

    def left(self, theta: Array) -> Array:
        """White torque (N) that values of the columns leave unexplained."""
        return np.asarray(self.torque - theta @ self.columns)


def comparable(run: Prepared, found: Search) -> bool:
    """Whether the noise of the runs that were searched is that of this one too: a log takes what is above its own
    frequencies for slower noise.
    """
    rate, others = run.sampled.run.rate, [one.sampled.run.rate for one in found.bank.runs]
    return any(max(rate, other) < _UNLIKE * min(rate, other) for other in others)


def along(found: Search, test: Sequence[Prepared]) -> Trial | None:
    """Joints that the other runs show, white by the noisiest of them, along runs that were logged about as fast.

    None without rows, and where what was found is impossible along a run: a testing run may lack what the
    others have, such as a temperature.
    """
    test = [run for run in test if comparable(run, found)]
    if not test:
        return None
    like = found.bank.scenes[0]
    jumps = Acting(tuple(found.variants)).jumps
    test = [run.without_standstill(jumps) for run in test]
    bank = Bank(test, [Scene(run.sampled, like.regressors, like.values, like.beside) for run in test])
    known = found.bank.shown
    rates = [run.rate for run in found.bank.runs]
    of_joint = list(zip(*found.bank.colours, strict=True))
    loudest = [int(np.argmax([one.deviations[-1] for one in mine])) for mine in of_joint]

    def noise(k: int, rate: float) -> Colour:
        r = loudest[k]
        return at_rate(of_joint[k][r], rates[r], rate) if k in known else _PLAIN

    places: dict[tuple[str, int], tuple[int, ...]] = {}
    for variant in found.variants:
        there = bank.add(variant.hypothesis, variant.shape)
        if there is None and variant.key not in bank.nowhere:
            return None
        places[variant.key] = there.columns if there else (-1,) * len(variant.hypothesis.coefficients)
    bank.whiten([[noise(k, run.rate) for k in range(bank.dof)] for run in test])
    blocks, usual = [np.empty((bank.count + 1, 0))], [np.empty(0)]
    for r in range(len(test)):
        for k in known:
            numbers, white = bank.white(r, k)
            block = np.zeros((bank.count + 1, white.shape[1]))
            block[[*numbers, bank.count]] = white
            blocks.append(block)
            mean = np.sqrt(np.mean([one.deviations[-1] ** 2 for one in of_joint[k]]))
            usual.append(np.full(white.shape[1], mean / of_joint[k][loudest[k]].deviations[-1]))
    rows = np.concatenate(blocks, axis=1)
    if not rows.shape[1]:
        return None
    return Trial(found.weighing.all, rows[:-1], rows[-1], bank, known, np.concatenate(usual), places)
