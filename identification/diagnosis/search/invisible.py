"""What the runs cannot show, whatever it were."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from identification.diagnosis.columns.hypothesis import LENGTH, SHAPE, VALUE, Hypothesis, Key, asked_for
from identification.diagnosis.search.weighing import Weighing

#: Other values of what the file has: of those there is nothing to be shown.
_OF_FILE = (LENGTH, SHAPE, VALUE)
#: What shows an effect that makes no torque along the runs.
_ELSEWHERE = "other motion, or the base mounted another way: along these runs it makes no torque"


def invisible(weighing: Weighing) -> list[Hypothesis]:
    """Hypotheses of which, with most of their shapes, the model takes up nearly all (``least_part``); then those that
    make no torque along the runs. What may be of one joint is told of each.
    """
    hidden: dict[Key, list[bool]] = {}
    whose: dict[Key, Hypothesis] = {}
    for variant in weighing.bank.variants:
        key = variant.key
        if variant.hypothesis.kind not in _OF_FILE:
            hidden.setdefault(key, []).append(not weighing.visible(variant))
            whose[key] = variant.hypothesis
    taken_up = [whose[key] for key, shapes in hidden.items() if np.mean(shapes) > 0.5]
    nowhere = [
        one
        for key, one in weighing.bank.nowhere.items()
        if key not in hidden and not one.measured and one.kind not in _OF_FILE
    ]
    found = [*taken_up, *(replace(one, would_show=_ELSEWHERE) for one in nowhere)]
    of_one = {effect for effect, joint in (*hidden, *weighing.bank.nowhere) if joint}
    told = [one for one in found if one.joint or one.effect not in of_one]
    return [replace(one, would_show=asked_for(one.would_show, weighing.free)) for one in told]
