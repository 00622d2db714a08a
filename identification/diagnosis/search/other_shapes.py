"""Other shapes of the file's own effects, looked for where what the robot may lack beside them does not do.

What is missing is thought of first. A shape that is wrong leaves something of every law on its joint, so that others
stand in for it: the search begins once more without them.
"""

from __future__ import annotations

from collections.abc import Sequence

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import SHAPE, Hypothesis
from identification.diagnosis.search import load_or_gains
from identification.diagnosis.search.selection import Choice, Selection
from identification.diagnosis.search.tied_shapes import tied, tied_cost
from identification.diagnosis.search.weighing import Weighing

#: Part of the noise's power from which what is left of a joint counts.
_LEFT = 0.1
#: By how much other shapes must cost less than what stands in for them, at least and as a part of what that explains.
_BETTER, _PART = 6.0, 0.05


def searched(weighing: Weighing, start: Sequence[Variant], shapes: Sequence[Hypothesis]) -> list[Choice]:
    """What a search from ``start`` finds; where that names something on joints of other ``shapes``, or leaves more than
    noise there, what one finds that has those as well if it costs clearly less.
    """
    found = load_or_gains.searched(weighing, [one for one in start if one.hypothesis.kind != SHAPE])
    asked = [one for one in shapes if _lacks(weighing, found, one)]
    if not asked:
        return found
    weighing.bank.offer(asked)
    weighing.refresh()
    joints = {one.joint for one in asked}
    kept = [one for one in _variants(found) if joints.isdisjoint(one.hypothesis.numbers)]
    begun = [*kept, *(one for one in start if one.hypothesis.kind == SHAPE)]
    selection = Selection(weighing)
    again = tied(weighing, _variants(selection.search(begun)))
    if again is None:
        return found
    nothing, now = (weighing.cost(each) for each in (kept, _variants(found)))
    less = now - tied_cost(weighing, again) > _BETTER + _PART * max(nothing - now, 0.0)
    return selection.choices(again) if less else found


def _variants(choices: Sequence[Choice]) -> list[Variant]:
    return [one.evidence.variant for one in choices]


def _lacks(weighing: Weighing, found: Sequence[Choice], shape: Hypothesis) -> bool:
    """Whether something was found on the joint of a shape, or more than noise is left there."""
    chosen, bank = _variants(found), weighing.bank
    if any(shape.joint in one.hypothesis.numbers for one in chosen):
        return True
    k = bank.robot.numbers.index(shape.joint)
    weights = weighing.fitted_to(weighing.train, chosen)
    each = [bank.residual(r, k, weights) for r in weighing.train]
    rows = sum(map(len, each))
    return sum(float(e @ e) for e in each) > (1 + _LEFT) * rows
