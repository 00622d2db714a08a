"""What the runs that test say of each finding: they choose nothing, but what they contradict is taken back.

The model with a finding and the one without it, both fitted to the other runs, predict torques of the testing runs that
differ by d, in units of the noise. Where the finding is true the sum of squares falls by |d|^2 + 2 e d with it, e what
the model with it leaves: noise, the uncertainty of the fit, and whatever else is new there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.bank import Bank, Variant
from identification.diagnosis.evidence import key_of
from identification.diagnosis.loop import Search
from identification.diagnosis.prepared import Prepared
from identification.diagnosis.scene import Scene
from identification.diagnosis.selection import Choice, Selection
from identification.diagnosis.whitening import Colour

Array = NDArray[np.float64]

#: Least |d|^2 at which the testing runs tell anything of a finding.
_TOLD = 9.0
#: Noise of joints that no row of the other runs shows.
_PLAIN = Colour((np.ones(1),), (1.0,))
#: Standard deviations by which a true finding never falls short.
_NEVER = 3.0


def confirmed(found: Search, test: Sequence[Prepared]) -> tuple[Search, tuple[Choice, ...]]:
    """The search without the choices that ``test`` contradicts, and those; the most contradicted goes first.

    What passed only beside one that is taken back goes too.
    """
    testing = _along(found, test) if found.choices and test else None
    if testing is None:
        return found, ()
    staying = list(found.choices)
    while staying:
        short, worst = min(((testing.short(staying, one), one) for one in staying), key=lambda pair: pair[0])
        if short >= 0:
            break
        staying.remove(worst)
    if len(staying) == len(found.choices):
        return found, ()
    again = Selection(found.weighing).choices([one.evidence.variant for one in staying])
    kept = {key_of(one.evidence.variant) for one in again}
    gone = tuple(one for one in found.choices if key_of(one.evidence.variant) not in kept)
    away = {key_of(one.evidence.variant) for one in gone}
    told = [
        replace(one, alternatives=tuple(other for other in one.alternatives if key_of(other.variant) not in away))
        for one in again
    ]
    return found.keeping(told), gone


@dataclass(frozen=True)
class _Testing:
    """White ``rows`` (c + 1 x N) of the testing runs: base columns, those of the choices, the torque.

    ``places`` tells the rows of each variant's columns, by its effect and joint; -1 where they make no torque.
    """

    found: Search
    rows: Array
    places: dict[tuple[str, int], tuple[int, ...]]

    def short(self, staying: Sequence[Choice], one: Choice) -> float:
        """By how many standard deviations the testing runs contradict a choice beside the others, negative; else 0."""
        theta, C = self._fitted(staying)
        fewer, _ = self._fitted([other for other in staying if other is not one])
        columns = self.rows[:-1]
        d = (theta - fewer) @ columns
        size = float(d @ d)
        if size < _TOLD:
            return 0.0
        left = self.rows[-1] - theta @ columns
        gained = size + float(2 * left @ d)
        along = columns @ d
        variance = 4 * (float(np.mean(left**2)) * size + float(along @ C @ along))
        if gained >= 0 or gained >= size - _NEVER * np.sqrt(variance):
            return 0.0
        return (gained - size) / float(np.sqrt(variance))

    def _fitted(self, choices: Sequence[Choice]) -> tuple[Array, Array]:
        """Values of the rows' columns as the other runs fit them (c), 0 without a choice; their covariance (c x c)."""
        variants = [one.evidence.variant for one in choices]
        solution, covariance = self.found.weighing.all.solution([n for one in variants for n in one.columns])
        base = range(len(self.found.bank.base))
        at = np.array([*base, *(place for one in variants for place in self.places[key_of(one)])])
        acts = at >= 0
        theta, C = np.zeros(len(self.rows) - 1), np.zeros((len(self.rows) - 1,) * 2)
        theta[at[acts]] = solution[acts]
        C[np.ix_(at[acts], at[acts])] = covariance[np.ix_(acts, acts)]
        return theta, C


def _along(found: Search, test: Sequence[Prepared]) -> _Testing | None:
    """Joints that the other runs show, white by the noisiest of them; None where a choice is impossible along a run."""
    usual = found.bank.scenes[0]
    bank = Bank(test, [Scene(run.sampled, usual.regressors, usual.values, usual.beside) for run in test])
    shown = np.sum([found.bank.rows(r) for r in (*found.train, *found.validate)], axis=0) > 0
    noisiest = [
        max(mine, key=lambda one: one.deviations[-1]) if seen else _PLAIN
        for mine, seen in zip(zip(*found.bank.colours, strict=True), shown, strict=True)
    ]
    places: dict[tuple[str, int], tuple[int, ...]] = {}
    for one in found.choices:
        columns = _columns(bank, one.evidence.variant)
        if columns is None:
            return None
        places[key_of(one.evidence.variant)] = columns
    bank.whiten([noisiest for _ in test])
    blocks = [np.empty((bank.count + 1, 0))]
    for r in range(len(test)):
        for k in np.flatnonzero(shown):
            numbers, white = bank.white(r, int(k))
            block = np.zeros((bank.count + 1, white.shape[1]))
            block[[*numbers, bank.count]] = white
            blocks.append(block)
    return _Testing(found, np.concatenate(blocks, axis=1), places)


def _columns(bank: Bank, variant: Variant) -> tuple[int, ...] | None:
    """Numbers of a variant's columns along the testing runs, -1 where they make no torque; None where that is
    impossible: a testing run may lack what the others have, such as a temperature.
    """
    there = bank.add(variant.hypothesis, variant.shape)
    if there is not None:
        return there.only(variant.used).columns
    return (-1,) * len(variant.used) if key_of(variant) in bank.nowhere else None
