"""What the laws of effects that were found may leave although they are the right ones: laws are never exact."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import SINCE_REVERSAL, VALUE, Hypothesis
from identification.diagnosis.search.likely import balances, common

#: What lets the link come after the motor, or the log after both.
_BEHIND = ("joint_elasticity", "backlash", "torque_delay")
#: What a joint has one of, as of balancers: a robot file says no more, and the second tells what the first one leaves.
_ONE_OF = ("joint_elasticity", "backlash")
#: Laws are never exact: least part of what others that are not common (beside another value than the known one, of all)
#: explain on the same joint, where they show over nearly the same, and where they are alike: friction of the speed, or
#: behind the motor.
ELSE, BESIDE, _ALIKE = 0.01, 0.03, 0.15
#: The same part of a delay of the whole robot, which shifts torques and does no more, but for what a reversal tells.
_SHIFTED = 0.002
#: The same part of what they explain anywhere: base parameters bring it to every joint; and for a delay that the rows
#: of several motors tell alike.
ANYWHERE = 1e-5
#: The same part of a balancer for a second one.
_SECOND = 0.5
#: Variables of the speed's history.
OF_SPEED = ("qd", SINCE_REVERSAL)
#: Variables over which an effect of one of them shows as well.
_SHOWN_ALIKE = (("q", "q by direction", "motor phase", "load"), (*OF_SPEED, "time"), ("frequency",))


def lacking(variant: Variant, others: Sequence[Variant], drops: Sequence[float]) -> float:
    """What the laws of ``others``, which explain ``drops`` of the sum of squares, may lack and a variant would explain;
    infinite where it cannot be beside one of them.
    """
    return max(lacks(variant, others, drops), default=0.0) if stands(variant, others) else inf


def stands(variant: Variant, others: Sequence[Variant]) -> bool:
    """Whether what a variant goes beyond is among ``others``; of what is likely enough it need not be."""
    there = {each.name for one in others for each in one.coefficients}
    return _likely_enough(variant) or there.issuperset(variant.hypothesis.beyond)


def lacks(variant: Variant, others: Sequence[Variant], drops: Sequence[float]) -> list[float]:
    """The same of each of the ``others``."""
    return [_lacks(variant, one, drop) for one, drop in zip(others, drops, strict=True)]


def _likely_enough(variant: Variant) -> bool:
    """Whether it is missing likely enough: what is common; what is known may only seem to have another value."""
    return common(variant) and variant.hypothesis.kind != VALUE


def _lacks(variant: Variant, one: Variant, drop: float) -> float:
    mine, theirs = variant.hypothesis, one.hypothesis
    if _likely_enough(variant):
        return 0.0
    if _exclude(mine, theirs):
        return inf
    if balances(mine.effect) and balances(theirs.effect):
        return _SECOND * drop
    if common(one) and mine.kind != VALUE:
        return 0.0
    part = _part(mine, theirs)
    near = bool(set(one.coordinates) & set(variant.coordinates))
    return (part if near else min(part, ANYWHERE)) * drop


def _exclude(one: Hypothesis, other: Hypothesis) -> bool:
    """Whether a joint has one of them alone."""
    both = (one.effect, other.effect)
    return one.joint == other.joint and (all(map(balances, both)) or set(both) <= set(_ONE_OF))


def _part(one: Hypothesis, other: Hypothesis) -> float:
    """Part of what ``other`` explains that its law may lack and ``one`` would explain."""
    # Each is told by rows of its own, not by what the other leaves.
    if one.preset and other.preset:
        return 0.0
    # Gains have no law but themselves.
    if one.effect == other.effect == "torque_gain":
        return ELSE
    # The rows of several motors tell it alike: no law of one joint lacks that.
    if one.preset and len(one.joints) > 1 and other.joint != 0:
        return ANYWHERE
    # What a delay of the whole robot explains is not of one joint.
    behind = {one.effect, other.effect} <= set(_BEHIND) and other.joint != 0
    if behind or {one.variable, other.variable} <= set(OF_SPEED):
        return _ALIKE
    if (other.effect, other.joint) == ("torque_delay", 0) and one.variable not in ("frequency", SINCE_REVERSAL):
        return _SHIFTED
    return BESIDE if any({one.variable, other.variable} <= set(group) for group in _SHOWN_ALIKE) else ELSE
