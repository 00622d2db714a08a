"""Gains that double a torque or halve it, beside the model that they scale: both found by turns, without any other
candidate.

The column of a gain is the model's torque by the values before. What those have too much the new ones have too little,
times the gain's error: where that is about 1 or more, searches alone swing about the truth and end anywhere; where the
torque is about halved they creep towards it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from identification.diagnosis.columns.acting import Acting
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.search.settling import fitted, made_anew
from identification.diagnosis.search.weighing import Weighing

#: Relative error of a torque from which it counts, turns at most, and its change that is none.
_DOUBLES, _TURNS, _NEAR = 0.5, 15, 0.003


def doubling(acting: Acting) -> bool:
    """Whether a gain that acts about doubles its torque, or takes half of it."""
    return max(map(abs, _gains(acting)), default=0.0) >= _DOUBLES


def settled(
    weighing: Weighing, chosen: Sequence[Variant], values: Mapping[str, float]
) -> tuple[list[Variant], dict[str, float], Acting]:
    """What was ``chosen`` beside columns by ``values`` of the base parameters, these values by name when turns change
    them no more, and what acts.
    """
    old = dict(values)
    last: tuple[float, ...] = ()
    for _ in range(_TURNS):
        new, acting = fitted(weighing, chosen)
        gains = _gains(acting)
        still = len(gains) == len(last) and all(abs(x - y) < _NEAR for x, y in zip(gains, last, strict=True))
        if still and all(abs(x - old.get(name, x)) <= _NEAR * abs(x) for name, x in new.items()):
            break
        last = gains
        # Half way between what is too much and what is too little.
        old = {name: (x + old.get(name, x)) / 2 for name, x in new.items()}
        again = made_anew(weighing, chosen, old, acting)
        if again is None:
            break
        weighing, chosen = again
    return list(chosen), old, acting


def _gains(acting: Acting) -> tuple[float, ...]:
    return tuple(x for name, x in acting.coefficients.items() if name.startswith("torque_gain_error"))
