"""Effects that scale a drive's torque scale all of it: what the model has, and what was found beside it.

Where only what was found grows or fades, its own law is another one, and no drive has changed. Where the fit takes up
whatever scales the model's own torque, only what was found would tell of the drive: a gain that takes its place.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from identification.diagnosis.columns.bank import Variant, columns_of
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.columns.normal_equations import inverse
from identification.diagnosis.search.weighing import Weighing

#: Least part of an effect's coefficients that the model's own torque must show, and the deviation, in parts of them,
#: from which the runs do not tell.
_SHOWN, _VAGUE = 0.5, 0.25


def taken_up(weighing: Weighing) -> list[Hypothesis]:
    """Gains of drives one by one whose part of the model's own torque the fit takes up."""
    mine = [one for one in weighing.bank.variants if one.hypothesis.of_model and one.hypothesis.joint]
    gains = [one for one in mine if not one.hypothesis.shapes]
    return [one.hypothesis for one in gains if (own := _own(weighing, one)) and not weighing.visible(own)]


def scales_all(weighing: Weighing, variant: Variant, others: Sequence[Variant]) -> bool:
    """Whether the model's own torque shows and is scaled like the rest, as far as the runs tell; also of what scales
    nothing.
    """
    if variant.hypothesis.of_model is None or not _beside(weighing) or (own := _own(weighing, variant)) is None:
        return True
    if not weighing.visible(own):
        return False
    products = weighing.normal.part([*variant.columns, *own.columns], columns_of(others))
    C = inverse(products[:-1, :-1], 1e-8)
    k = len(variant.columns)
    values = C @ products[:-1, -1]
    # The first coefficient of the whole torque, and of the model's where both may differ.
    whole = float(weighing.beside(variant, others)[0][0])
    pick = np.eye(2 * k)[0] + np.eye(2 * k)[k]
    std = float(np.sqrt(pick @ C @ pick))
    return std > _VAGUE * abs(whole) or float(pick @ values) * np.sign(whole) > _SHOWN * abs(whole)


def _own(weighing: Weighing, variant: Variant) -> Variant | None:
    """What an effect that scales a drive's torque makes of the model's own, None of what scales nothing."""
    hypothesis = variant.hypothesis
    if hypothesis.of_model is None:
        return None
    alone = replace(hypothesis, effect=f"{hypothesis.effect} of the model", columns=hypothesis.of_model)
    part = weighing.bank.add(alone, variant.shape, offered=False)
    if part is None:
        return None
    weighing.refresh()
    return part.only(variant.used)


def _beside(weighing: Weighing) -> bool:
    """Whether anything that was found makes torque beside the model's."""
    return any(not np.array_equal(scene.torque, scene.model_torque) for scene in weighing.bank.scenes)
