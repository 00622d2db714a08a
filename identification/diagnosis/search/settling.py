"""Swings beside the model that they change: shapes and base parameters found by turns, without any other candidate.

The load under which a drive train swings is that of base parameters which were fitted beside the swings under the load
before: searches alone would settle in a dozen of them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf

from identification.diagnosis.columns.acting import Acting
from identification.diagnosis.columns.bank import Bank, Variant
from identification.diagnosis.columns.hypothesis import ELASTIC
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.search.refinement import refined
from identification.diagnosis.search.weighing import Weighing

#: Turns, those that may pass without less being left, by this part, and steps of the shapes in each.
_TURNS, _PATIENCE, _LESS, _STEPS = 8, 2, 0.01, 10


def swinging(chosen: Sequence[Variant]) -> bool:
    """Whether any is an elastic drive train."""
    return any(map(_swings, chosen))


def settled(weighing: Weighing, chosen: Sequence[Variant]) -> tuple[list[Variant], dict[str, float], Acting]:
    """What was ``chosen``, with the shapes of drive trains settled; the base parameters by name beside it; and both as
    they act: of all turns, which make banks of their own, the one that leaves least.
    """
    best = list(chosen), *fitted(weighing, chosen)
    # What the start leaves is no measure: its swings are under the loads of other base parameters.
    least, waited = inf, 0
    for _ in range(_TURNS):
        again = made_anew(weighing, chosen, *fitted(weighing, chosen))
        if again is None:
            break
        weighing, chosen = again
        for i, one in enumerate([*chosen]):
            if _swings(one):
                chosen[i] = refined(weighing, one, [*chosen[:i], *chosen[i + 1 :]], _STEPS)
        left = weighing.misfit(chosen)
        waited = 0 if left < (1 - _LESS) * least else waited + 1
        if left < least:
            least, best = left, (list(chosen), *fitted(weighing, chosen))
        if waited == _PATIENCE:
            break
    return best


def made_anew(
    weighing: Weighing, chosen: Sequence[Variant], values: Mapping[str, float], acting: Acting
) -> tuple[Weighing, list[Variant]] | None:
    """What weighs ``chosen`` variants in a bank of their own, and they there, their columns by ``values`` of the base
    parameters and by what is ``acting``; None where one of them makes no torque.
    """
    old = weighing.bank
    bank = Bank(old.runs, [Scene(one.sampled, one.regressors, values, acting) for one in old.scenes])
    made = [(one, bank.add(one.hypothesis, one.shape)) for one in chosen]
    again = [new.only(one.used) for one, new in made if new is not None]
    if len(again) < len(chosen):
        return None
    bank.whiten(old.colours)
    return weighing.along(bank), again


def fitted(weighing: Weighing, chosen: Sequence[Variant]) -> tuple[dict[str, float], Acting]:
    """Base parameters by name beside what was ``chosen``, and that as it acts."""
    bank, (solution, _) = weighing.bank, weighing.fitted(chosen)
    return bank.values(solution), Acting.found(bank, chosen, solution)


def _swings(one: Variant) -> bool:
    return one.hypothesis.kind == ELASTIC
