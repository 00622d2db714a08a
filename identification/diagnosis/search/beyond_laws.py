"""What is of no law of another effect, though that explains so much that it may lack more.

A law is wrong on the joints on which it acts: elsewhere only base parameters carry what it lacks. And what it lacks has
a form of its own: another effect that leaves nothing of it, and shows over another variable or at a whole order, is no
part of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from identification.diagnosis.columns.bank import Bank, Variant, columns_of
from identification.diagnosis.columns.normal_equations import Normal
from identification.diagnosis.search.imperfect_laws import ANYWHERE, BESIDE, ELSE, lacks, stands

#: Part of what a variant explains that is elsewhere.
_MOST = 0.5
#: Parts of what is left of its joints, beyond noise, between which what it explains is all of that: beyond, it explains
#: noise.
_ALL, _TWICE = 0.9, 2.0
#: Standard deviations by which a value that another fit tells may be off; part of what it explains that it leaves at
#: least.
_DEVIATIONS, _LEFT = 3.0, 1e-3


@dataclass(frozen=True)
class BeyondLaws:
    """Asks the rows of some ``runs``, by number, with their ``normal`` equations."""

    bank: Bank
    normal: Normal
    runs: Sequence[int]

    def explains(self, variant: Variant, drop: float, others: Sequence[Variant], drops: Sequence[float]) -> bool:
        """Whether a variant that lowers the sum of squares by ``drop``, beside ``others`` of ``drops`` whose laws may
        lack as much, explains what is no part of them.
        """
        if not stands(variant, others):
            return False
        each = zip(others, drops, lacks(variant, others, drops), strict=True)
        hiding = [(one, theirs, lack) for one, theirs, lack in each if lack > drop]
        if not hiding or any(lack > BESIDE * theirs for _, theirs, lack in hiding):
            return False
        if any(drop < _of_its_value(one) * theirs for one, theirs, _ in hiding):
            return False
        before = self.normal.by_number(columns_of(others))
        left = sum(self._beyond_noise(before, k) for k in variant.coordinates)
        own = _of_whole_orders(variant) or all(lack <= ELSE * theirs for _, theirs, lack in hiding)
        if own and _ALL * left < drop < _TWICE * left:
            return True
        after = self.normal.by_number(columns_of([*others, variant]))
        aside = set(variant.coordinates).difference(*(one.coordinates for one, *_ in hiding))
        fallen = sum(self._beyond_noise(before, k) - self._beyond_noise(after, k) for k in sorted(aside))
        return fallen > max(_MOST * drop, *(ANYWHERE * theirs for _, theirs, _ in hiding))

    def _beyond_noise(self, values: dict[int, float], k: int) -> float:
        """The sum of squares beyond the noise's that they leave of coordinate k."""
        square, rows = self.bank.left_over(k, values, self.runs)
        return square - rows


def _of_whole_orders(variant: Variant) -> bool:
    return any(shape.whole for shape in variant.hypothesis.shapes)


def _of_its_value(one: Variant) -> float:
    """Part of what a variant explains that it leaves where it is told by another fit, as closely as that tells it."""
    told = [value for value in one.hypothesis.preset.values() if value.value]
    return max((max((_DEVIATIONS * value.std / (value.value or 1.0)) ** 2, _LEFT) for value in told), default=0.0)
