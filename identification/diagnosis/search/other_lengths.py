"""Other lengths than the robot's file has, looked for where something is missing.

A length that is wrong leaves something on many joints, so that other laws stand in for it, one here and one there. It
is rarer than they are: it counts where with it less is missing, of which those do not pass beside it any more.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import LENGTH, Hypothesis, Key
from identification.diagnosis.search import other_shapes
from identification.diagnosis.search.more_than_noise import more_than_noise
from identification.diagnosis.search.selection import Choice, Selection
from identification.diagnosis.search.tied_shapes import tied_cost
from identification.diagnosis.search.weighing import Weighing

#: Part of the noise's power from which what is left of a joint counts where nothing was found.
_LEFT = 0.05
#: By how much a length must make what is missing cost less, at least and as a part of what stood in for it.
_BETTER, _PART = 20.0, 0.01


def searched(
    weighing: Weighing, start: Sequence[Variant], shapes: Sequence[Hypothesis], lengths: Sequence[Hypothesis]
) -> list[Choice]:
    """What a search from ``start`` finds, other ``shapes`` of the file's effects among it; and where that is something,
    or leaves more than noise, what it finds beside other ``lengths`` if it costs clearly less. A length of ``start``
    stays while without it nothing costs less.
    """
    before = {one.key for one in start if one.hypothesis.kind == LENGTH}
    found = other_shapes.searched(weighing, [one for one in start if one.key not in before], shapes)
    chosen = [one.evidence.variant for one in found]
    if not (chosen or more_than_noise(weighing, [], range(weighing.bank.dof), _LEFT)):
        return found
    weighing.bank.offer(lengths)
    weighing.refresh()
    more = _with_another(weighing, Selection(weighing), chosen, before)
    return found if more is None else Selection(weighing).choices(more)


def _with_another(
    weighing: Weighing, selection: Selection, chosen: Sequence[Variant], before: Collection[Key]
) -> list[Variant] | None:
    """The length with which what is missing costs least, what passes beside it of what was ``chosen``, and what else is
    missing then, other lengths too; None where none costs clearly less, or, of those found ``before``, no less.
    """
    now, best, gain = tied_cost(weighing, chosen), None, 0.0
    for one in (each for each in weighing.bank.variants if each.hypothesis.kind == LENGTH):
        for beside in _besides(chosen):
            if not weighing.of(one, beside).passes:
                continue
            together = selection.standing([*beside, one])
            kept = [each for each in together if each.key != one.key]
            less = now - tied_cost(weighing, together)
            stood_in = max(tied_cost(weighing, kept) - now, 0.0)
            clear = less if one.key in before else less - _BETTER - _PART * stood_in
            if len(kept) < len(together) and clear > gain:
                best, gain = together, clear
    if best is None:
        return None
    found = [one.evidence.variant for one in selection.search(best)]
    return min((found, best), key=lambda each: tied_cost(weighing, each))


def _besides(chosen: Sequence[Variant]) -> list[list[Variant]]:
    """What a length is tried beside: all that was chosen, all but one of it, which may stand in for the length, and
    nothing.
    """
    but_one = [[each for each in chosen if each is not one] for one in chosen]
    return [list(chosen), *but_one, *([[]] if len(chosen) > 1 else [])]
