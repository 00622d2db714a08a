"""Why a finding may stand for something else: rules by which it is tentative, each with its reason in words."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from identification.diagnosis.columns.hypothesis import BODY, EFFECT, ELASTIC, LOAD, PRIOR, SHAPE, SINCE_REVERSAL, VALUE
from identification.diagnosis.search.likely import balances, misplaces, pulls
from identification.diagnosis.verdict.alternatives import (
    OTHER_BODY,
    OTHER_FRICTION,
    OTHER_GEOMETRY,
    OTHER_TORQUE,
    outside,
)
from identification.diagnosis.verdict.finding import TENTATIVE, Finding, vague
from identification.outcome import Value

#: What is left on a joint, in parts of what a finding explains there, from which it is not firm; of what pulls a link
#: to where it rests, and of friction over the position, which any torque of the position looks like.
_LEFT, _PULLED = 1.0, 0.15
#: Size, in parts of the noise's rms, below which a torque of the position is any, and what places links elsewhere any
#: fault of the geometry; what is left on a torque's joint, in those parts too, and standard deviation of its values, in
#: parts of them, from which it is any.
_FAINT, _SHOWS, _LOOSE = 0.3, 0.4, 0.2
#: What only refines a torque of the position, in parts of the rest, from which it bends as no known law does.
_BENT = 1.0
#: What a finding over a variable of friction explains, in parts of what friction that warms up on its joint does, in
#: squares, from which the law by which that warms makes as much.
_OF_FRICTION, _WARMED = ("q by direction", "qd", "load"), 0.05
#: What is left of a swinging joint, in parts of the noise's rms and of what was explained, from which its law is not
#: sure; and the standard deviation of a gap, in parts of it, from which there may be none.
_SWUNG, _SWUNG_OF, _GAP = 1.0, 0.3, 0.25
#: Reasons of several rules.
_MUCH = "much is left on its joint beside what it explains there"
_UNDETERMINED = "the runs do not determine its values"
_SMALL = "it is small beside the noise"


def doubted(one: Finding, remains: float, several: Collection[int], repeats: bool, free: bool = False) -> Finding:
    """Tentative where its torque is known and its law is not: too much ``remains``, in parts of it, on the joint where
    it is largest, it is one of ``several`` springs on a joint, or the runs do not tell the values that make it a
    balancer or a payload and not any torque; the values of what slides before it slips, and where no motion
    ``repeats`` those of any effect; where it is little of what links do that stand elsewhere, of which a ``free``
    fit takes up most, however they come to stand there; where no motion tells it from a value of a body; or where a
    known offset is other by so little that any other fault of what is known makes as much.
    """
    effect, kind = one.hypothesis.effect, one.hypothesis.kind
    if reasons := _any_torque(one, remains, several):
        whole = "motion over the joint's whole range, with another payload"
        other = outside(OTHER_TORQUE, "another torque of the position", one.joints, one.evidence, whole)
        return one.doubted(*reasons, alternatives=[other])
    if effect == "position_friction" and _much(one, remains):
        loads = "the same motion with another payload, which changes friction under load"
        other = outside(OTHER_FRICTION, "other friction that changes along the range", one.joints, one.evidence, loads)
        return one.doubted(_MUCH, alternatives=[other])
    if all(map(_unknown, one.main)):
        return one.doubted("its values are no larger than their standard deviations", sure=False)
    if free and misplaces(one.hypothesis) and one.evidence.size < _FAINT:
        poses = f"measured poses of the tool, or {PRIOR}"
        other = outside(OTHER_GEOMETRY, "another fault of the geometry", one.joints, one.evidence, poses)
        return one.doubted(_SMALL, alternatives=[other])
    if kind == VALUE and one.hypothesis.grouped:
        told = "data of motor and gear, or of the bodies"
        other = outside(OTHER_BODY, "another value of a body than the known one", one.joints, one.evidence, told)
        return one.doubted("no motion tells it from a value of a body", alternatives=[other])
    if kind == VALUE and effect == "offset" and one.evidence.size < _FAINT:
        poses = "measured poses of the tool, and other sources of what is known"
        other = outside(OTHER_GEOMETRY, "another fault of what is known", one.joints, one.evidence, poses)
        return one.doubted(_SMALL, alternatives=[other])
    if kind in (EFFECT, SHAPE) and not one.determined and one.variable == SINCE_REVERSAL:
        return one.doubted(_UNDETERMINED)
    if kind in (EFFECT, ELASTIC, SHAPE) and not one.determined and not repeats:
        return one.doubted(f"{_UNDETERMINED}, and no motion repeats")
    if remains > _LEFT:
        return one.doubted("it leaves more on its joint than it explains there")
    if kind == LOAD and free:
        weighed = f"the payload on a scale, or {PRIOR}"
        other = outside("torque_gain", "the same error of all torques' gains", one.joints, one.evidence, weighed)
        there = [each.effect for each in one.alternatives]
        more = [] if "torque_gain" in there else [other]
        return one.doubted("a free fit scales all parameters with the payload's", alternatives=more)
    if kind == BODY and vague(one.main[0]):
        return _of_no_mass(one)
    if all(map(vague, one.main)):
        return one.doubted("the standard deviations of its values are more than half of them")
    return one


def _of_no_mass(one: Finding) -> Finding:
    """A payload whose mass is not determined; without any it may be too much of a body that is known."""
    if one.main[0].value:
        return one.doubted("the runs do not determine its mass")
    told = "the tool on a scale, or another source of what is known of the last bodies"
    title = "less of a body than is known"
    other = outside(OTHER_BODY, title, one.joints, one.evidence, told)
    return one.doubted("without mass it is no payload", alternatives=[other])


def _any_torque(one: Finding, remains: float, several: Collection[int]) -> list[str]:
    """Why it may be any torque of the position, if it pulls a link to where it rests."""
    effect = one.hypothesis.effect
    if not pulls(effect):
        return []
    undetermined = balances(effect) and not one.determined
    reasons = {
        _MUCH: _much(one, remains),
        "another torque of the position was found on its joint": not set(one.joints).isdisjoint(several),
        "the runs do not determine its values to a fifth": any(vague(value, _LOOSE) for value in one.main),
        "the runs tell its torque, which other values of its shape make as well": undetermined,
        "its hardening makes more torque than its stiffness": one.refined > _BENT,
        _SMALL: one.evidence.size < _FAINT,
    }
    return [reason for reason, holds in reasons.items() if holds]


def _much(one: Finding, remains: float) -> bool:
    return remains > min(_PULLED, _SHOWS / one.evidence.size)


def beside_any_torque(told: Sequence[Finding]) -> list[Finding]:
    """With offsets as sure as the torques of the position beside them: another law there takes another offset."""
    why = "another law in the place of the torque of the position on its joint takes another offset"
    return _as_sure("offset", [one for one in told if pulls(one.hypothesis.effect)], told, why)


def beside_drive_trains(told: Sequence[Finding]) -> list[Finding]:
    """With delays as sure as the drive trains beside them: a link that follows by another law is late as well."""
    why = "a link that follows its motor by another law than the drive train's beside it is late as well"
    return _as_sure("torque_delay", [one for one in told if one.hypothesis.kind == ELASTIC], told, why)


def _as_sure(effect: str, others: Sequence[Finding], told: Sequence[Finding], why: str) -> list[Finding]:
    """With findings of an ``effect`` doubted that share a joint with a tentative one of ``others``."""
    tentative = {number for one in others if one.status == TENTATIVE for number in one.joints}
    return [
        one.doubted(why) if one.hypothesis.effect == effect and not tentative.isdisjoint(one.joints) else one
        for one in told
    ]


def beside_warming(told: Sequence[Finding]) -> list[Finding]:
    """With what is little beside friction that warms up on its joint as sure as the law by which that warms."""
    warming = {number: one for one in told if one.hypothesis.effect == "warm_friction" for number in one.joints}
    why = "friction on its joint that warms up a little otherwise makes as much"
    return [
        one.doubted(why)
        if one.hypothesis.kind in (EFFECT, SHAPE)
        and one.variable in _OF_FRICTION
        and any(one.evidence.drop < _WARMED * warming[j].evidence.drop for j in one.joints if j in warming)
        else one
        for one in told
    ]


def doubted_drive_train(one: Finding, left: Mapping[int, float], remains: float) -> Finding:
    """Tentative where a drive train explains how a link swings and far more than noise is ``left`` all the same on a
    joint that its torque reaches, or much ``remains`` where it is largest, in parts of it; and where its gap is hardly
    more than none.
    """
    if one.hypothesis.kind != ELASTIC:
        return one
    (main, *_) = one.main
    if one.hypothesis.effect == "backlash" and (main.std or 0.0) > _GAP * abs(main.value or 0.0):
        title, experiment = "elasticity of the drive train without a gap", "motion in which the load changes its sign"
        other = outside("joint_elasticity", title, one.joints, one.evidence, experiment)
        return one.doubted("its gap is hardly larger than its standard deviation", alternatives=[other])
    if remains > _SWUNG_OF:
        return one.doubted(_MUCH)
    if any(left.get(number, 0.0) > _SWUNG for number in one.amplitude):
        return one.doubted("more than the noise is left on a joint that its torque reaches")
    return one


def _unknown(one: Value) -> bool:
    return (one.std or 0.0) >= abs(one.value or 0.0)
