"""Findings that are not in the new model since it explains their joints less well with them than the old one does.

A fit of white rows hardly weighs what changes slowly; a model plays all of it. What explains the one and spoils the
other is no effect of the robot.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from identification.diagnosis.mending.untouched import Untouched
from identification.diagnosis.mending.written_model import WrittenModel
from identification.diagnosis.verdict.finding import TENTATIVE, Finding

#: Findings that are left out by way of trial, at most.
_TRIED = 3


def without_harm(
    model: WrittenModel,
    model_of: Callable[[Sequence[Finding]], WrittenModel],
    tried_with: Callable[[WrittenModel], Mapping[int, Untouched]],
) -> tuple[WrittenModel, list[str]]:
    """The ``model`` without tentative findings that make it worse than the old one on each of their joints and without
    which it is better there, those of least evidence first; and what is to be told.
    """
    notes: list[str] = []
    doubtful = sorted((one for one in model.findings if one.status == TENTATIVE), key=lambda one: one.evidence.drop)
    if not doubtful:
        return model, notes
    tried = tried_with(model)
    for one in [one for one in doubtful if _spoiled(one, tried)][:_TRIED]:
        if not _spoiled(one, tried):
            continue
        less = model_of([other for other in model.findings if other is not one])
        instead = tried_with(less)
        if all(replace(tried[j], before=instead[j].after).worse for j in one.amplitude):
            told = [
                f"joint {j} ({tried[j].after.relative_to_mean:.3g} % of it is left, "
                f"{instead[j].after.relative_to_mean:.3g} % without)"
                for j in one.amplitude
            ]
            notes.append(f"{one.hypothesis.named} is not in the new model, which is worse with it on {', '.join(told)}")
            model, tried = less, instead
    return model, notes


def _spoiled(one: Finding, tried: Mapping[int, Untouched]) -> bool:
    return bool(one.amplitude) and all(j in tried and tried[j].worse for j in one.amplitude)
