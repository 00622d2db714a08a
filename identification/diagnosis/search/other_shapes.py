"""Other shapes of the file's own effects, looked for where what the robot may lack beside them does not do.

What is missing is thought of first. A shape that is wrong leaves something of every law on its joint, so that others
stand in for it: each is tried in their place as well, and then what else may be missing beside it.
"""

from __future__ import annotations

from collections.abc import Sequence

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import SHAPE, Hypothesis
from identification.diagnosis.search import load_or_gains
from identification.diagnosis.search.more_than_noise import more_than_noise
from identification.diagnosis.search.selection import Choice, Selection
from identification.diagnosis.search.tied_shapes import best_tied, refined_tied, tied_cost, whole
from identification.diagnosis.search.weighing import Weighing

#: Part of the noise's power from which what is left of a shape's joint counts beside what was found.
_LEFT = 0.1
#: By how much another shape must cost less than what stands in for it, at least and as a part of what that explains.
_BETTER, _PART = 6.0, 0.05


def searched(weighing: Weighing, start: Sequence[Variant], shapes: Sequence[Hypothesis]) -> list[Choice]:
    """What a search from ``start`` finds; where that names something on joints of other ``shapes``, or leaves more than
    noise there, what one finds that has those as well if it costs clearly less.
    """
    found = load_or_gains.searched(weighing, [one for one in start if one.hypothesis.kind != SHAPE])
    chosen = _variants(found)
    asked = [one for one in shapes if _asks(weighing, chosen, one)]
    weighing.bank.offer(asked)
    weighing.refresh()
    selection = Selection(weighing)
    while asked and (more := _with_another(weighing, chosen, asked)) is not None:
        asked = [one for one in asked if one.key not in {each.key for each in more}]
        chosen = _of_whole(weighing, _completed(weighing, selection, more))
    shaped = any(one.hypothesis.kind == SHAPE for one in chosen)
    return selection.choices(chosen) if shaped else found


def _variants(choices: Sequence[Choice]) -> list[Variant]:
    return [one.evidence.variant for one in choices]


def _asks(weighing: Weighing, chosen: Sequence[Variant], shape: Hypothesis) -> bool:
    """Whether something was found on the joint of a shape, or more than noise is left there."""
    if any(shape.joint in one.hypothesis.numbers for one in chosen):
        return True
    return more_than_noise(weighing, chosen, [weighing.bank.robot.numbers.index(shape.joint)], _LEFT)


def _with_another(weighing: Weighing, chosen: Sequence[Variant], shapes: Sequence[Hypothesis]) -> list[Variant] | None:
    """What was ``chosen`` with the one of ``shapes`` that costs least, beside what was found on its joint alone or in
    its place; None where none costs clearly less.
    """
    now, best, gain = tied_cost(weighing, chosen), None, 0.0
    for shape in shapes:
        elsewhere = [one for one in chosen if one.hypothesis.kind == SHAPE or one.hypothesis.numbers != (shape.joint,)]
        for beside in (list(chosen), elsewhere) if len(elsewhere) < len(chosen) else (elsewhere,):
            one = best_tied(weighing, shape, beside)
            if one is None:
                continue
            less = now - tied_cost(weighing, [*beside, one])
            least = _BETTER + _PART * max(tied_cost(weighing, beside) - now, 0.0)
            if less > least and less > gain and whole(weighing, one, [*beside, one]):
                best, gain = [*beside, one], less
    return best


def _completed(weighing: Weighing, selection: Selection, chosen: Sequence[Variant]) -> list[Variant]:
    """With what else is missing beside those that are ``chosen``, if that costs less."""
    found = _variants(selection.search(chosen))
    for i, one in enumerate(found):
        if one.hypothesis.kind == SHAPE:
            found[i] = refined_tied(weighing, one, [*found[:i], *found[i + 1 :]])
    return min((found, list(chosen)), key=lambda each: tied_cost(weighing, each))


def _of_whole(weighing: Weighing, chosen: Sequence[Variant]) -> list[Variant]:
    """Those that are no other shape of a part of an effect."""
    return [one for one in chosen if whole(weighing, one, chosen)]
