"""How far a shape value of a swinging drive train may be off before more is lost than the model leaves unexplained.

Where a link bounces, and what it leaves is more than noise, the curvature at the best value tells next to nothing of
that: a stiffness behind a gap may be several times as large, and explain nearly as much.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import exp, log, sqrt

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import ELASTIC, ShapeRange
from identification.diagnosis.search.loop import Search
from identification.diagnosis.search.refinement import refined
from identification.diagnosis.search.selection import Choice

#: Distance of the logarithm that is looked at first; each next one is twice as far.
_FIRST = 0.1
#: Steps of the other values at each.
_STEPS = 1


def reaching(found: Search, choice: Choice, std: Mapping[str, float], left: Mapping[int, float]) -> dict[str, float]:
    """Standard deviations of a choice's shape by name, no smaller than the farther way that each value may go, the
    others and all coefficients following, while no more is lost than is ``left`` on its joints, by number, beyond the
    noise's rms.

    Of values that are searched over their logarithm, and told by nothing else (``Hypothesis.twice``).
    """
    variant, deviation = choice.evidence.variant, dict(std)
    hypothesis = variant.hypothesis
    lost = sum(left.get(number, 0.0) ** 2 * _rows(found, number) for number in hypothesis.numbers)
    if hypothesis.kind != ELASTIC or not lost:
        return deviation
    others = [one for one in found.variants if one is not variant]
    elsewhere = {name for name, _ in hypothesis.twice.values()}
    for shape in hypothesis.shapes:
        if shape.log and shape.name in deviation and shape.name not in elsewhere:
            up, down = (_way(found, variant, others, shape, sign, lost) for sign in (1, -1))
            farther = variant.shape[shape.name] * max(exp(up) - 1, 1 - exp(-down))
            deviation[shape.name] = max(deviation[shape.name], farther)
    return deviation


def _way(found: Search, variant: Variant, others: list[Variant], shape: ShapeRange, sign: int, lost: float) -> float:
    """How far the logarithm of a value may go, up or down, until so much is ``lost`` or its range ends."""
    weighing, here = found.weighing, variant
    best, value = weighing.beside(variant, others)[1], variant.shape[shape.name]
    end = abs(log((shape.high if sign > 0 else shape.low) / value))
    reached, distance = 0.0, min(_FIRST, end)
    while reached < end:
        added = weighing.bank.add(variant.hypothesis, {**here.shape, shape.name: value * exp(sign * distance)})
        if added is None:
            return reached
        weighing.refresh()
        here = refined(weighing, added.only(variant.used), others, _STEPS, {shape.name})
        less = best - weighing.beside(here, others)[1]
        if less > lost:
            return max(reached, distance * sqrt(lost / less))
        reached, distance = distance, min(2 * distance, end)
    return reached


def _rows(found: Search, number: int) -> int:
    """Fitted rows of a joint."""
    k = found.bank.robot.numbers.index(number)
    return sum(int(found.bank.rows(r)[k]) for r in found.train)
