"""Other lengths than the robot's file has, looked for where something is missing.

A length that is wrong leaves something on many joints, so that other laws stand in for it, one here and one there. It
is rarer than they are: it counts where with it less is missing, of which those do not pass beside it any more.
"""

from __future__ import annotations

from collections.abc import Sequence

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import LENGTH, Hypothesis
from identification.diagnosis.search import other_shapes
from identification.diagnosis.search.selection import Choice, Selection
from identification.diagnosis.search.tied_shapes import tied_cost
from identification.diagnosis.search.weighing import Weighing

#: Part of the noise's power from which what is left of a joint counts.
_LEFT = 0.05
#: By how much a length must make what is missing cost less, at least and as a part of what stands in for it.
_BETTER, _PART = 20.0, 0.1


def searched(
    weighing: Weighing, start: Sequence[Variant], shapes: Sequence[Hypothesis], lengths: Sequence[Hypothesis]
) -> list[Choice]:
    """What a search from ``start`` finds, other ``shapes`` of the file's effects among it; and where that is something,
    or leaves more than noise, what it finds beside one of other ``lengths`` if it costs clearly less.
    """
    found = other_shapes.searched(weighing, [one for one in start if one.hypothesis.kind != LENGTH], shapes)
    chosen = [one.evidence.variant for one in found]
    if not (chosen or _lacks(weighing)):
        return found
    bank, selection = weighing.bank, Selection(weighing)
    offered = [bank.add(one, {}, offered=False) for one in lengths]
    weighing.refresh()
    more = _with_another(weighing, selection, chosen, [one for one in offered if one is not None])
    return found if more is None else selection.choices(more)


def _lacks(weighing: Weighing) -> bool:
    """Whether more than noise is left on a joint where nothing was found."""
    weights = weighing.fitted_to(weighing.train, [])
    left = [weighing.bank.left_over(k, weights, weighing.train) for k in range(weighing.bank.dof)]
    return any(power > (1 + _LEFT) * rows for power, rows in left)


def _with_another(
    weighing: Weighing, selection: Selection, chosen: Sequence[Variant], offered: Sequence[Variant]
) -> list[Variant] | None:
    """The one of ``offered`` with which what is missing costs least, what passes beside it of what was ``chosen``, and
    what else is missing then; None where none costs clearly less.
    """
    now, best, gain = tied_cost(weighing, chosen), None, 0.0
    for one in offered:
        if not any(weighing.of(one, beside).passes for beside in (chosen, [])):
            continue
        together = selection.standing([*chosen, one])
        kept = [each for each in together if each.key != one.key]
        less = now - tied_cost(weighing, together)
        least = _BETTER + _PART * max(tied_cost(weighing, kept) - now, 0.0)
        if len(kept) < len(together) and less > max(least, gain):
            best, gain = together, less
    if best is None:
        return None
    found = [one.evidence.variant for one in selection.search(best)]
    return min((found, best), key=lambda each: tied_cost(weighing, each))
