"""Another payload than the stated one, or gains of the motors: known values and unloaded runs tell them apart, but one
payload explains most of what several gains do, and hides each of them.
"""

from __future__ import annotations

from collections.abc import Sequence

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import LOAD
from identification.diagnosis.search.selection import Choice, Selection
from identification.diagnosis.search.weighing import Weighing


def searched(weighing: Weighing, start: Sequence[Variant]) -> list[Choice]:
    """What a search from ``start`` finds; where that is another payload, what one from all motors' gains finds if it
    costs less.
    """
    selection = Selection(weighing)
    found = selection.search(start)
    if all(one.evidence.variant.hypothesis.kind != LOAD for one in found):
        return found
    variants = weighing.bank.variants
    gains = [one for one in variants if one.hypothesis.effect == "torque_gain" and one.hypothesis.joint]
    return min(found, selection.search(gains), key=lambda each: weighing.cost([one.evidence.variant for one in each]))
