"""Findings that are not in the new model since it explains their joints less well with them than the old one does.

A fit of white rows hardly weighs what changes slowly; a model plays all of it. What explains the one and spoils the
other is no effect of the robot.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from generator.words import listed
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
    """The ``model`` without tentative findings that make it worse than the old one on each joint they are on, and
    without which it is better there, those of least evidence first, then all together of the same joints; and what is
    to be told. What is known of bodies must not be contradicted in their place.
    """
    notes: list[str] = []
    doubtful = sorted((one for one in model.findings if one.status == TENTATIVE), key=lambda one: one.evidence.drop)
    if not doubtful:
        return model, notes
    tried = tried_with(model)
    spoiling, asked_for = [one for one in doubtful if _spoiled(one, tried)][:_TRIED], list[Finding]()
    for several in [*([one] for one in spoiling), *_of_the_same_joints(spoiling)]:
        several = [one for one in several if one in model.findings and one not in asked_for and _spoiled(one, tried)]
        if not several:
            continue
        less = model_of([other for other in model.findings if other not in several])
        instead = tried_with(less)
        what = listed([one.hypothesis.named for one in several])
        if not all(replace(tried[j], before=instead[j].after).worse for j in _where(several[0])):
            continue
        if others := sorted(set(less.fit.contradicted).difference(model.fit.contradicted)):
            it = "it" if len(several) == 1 else "them"
            notes.append(f"without {what} the runs make {listed(others)} other than known: the new model has {it}")
            asked_for += several
            continue
        told = [
            f"joint {j} ({tried[j].after.relative_to_mean:.3g} % of it is left, "
            f"{instead[j].after.relative_to_mean:.3g} % without)"
            for j in _where(several[0])
        ]
        is_not, it = ("is not", "it") if len(several) == 1 else ("are not", "them")
        notes.append(f"{what} {is_not} in the new model, which is worse with {it} on {', '.join(told)}")
        model, tried = less, instead
    return model, notes


def _of_the_same_joints(found: Sequence[Finding]) -> list[list[Finding]]:
    """Findings that act on the same joints, where there are several: one may hide what the other spoils."""
    groups: dict[tuple[int, ...], list[Finding]] = {}
    for one in found:
        groups.setdefault(_where(one), []).append(one)
    return [several for several in groups.values() if len(several) > 1]


def _spoiled(one: Finding, tried: Mapping[int, Untouched]) -> bool:
    return bool(where := _where(one)) and all(j in tried and tried[j].worse for j in where)


def _where(one: Finding) -> tuple[int, ...]:
    """The joints that it is on: how a link swings shows on its neighbours too, but little."""
    return tuple(j for j in one.amplitude if j in one.joints) or tuple(one.amplitude)
