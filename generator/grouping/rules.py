"""In which order parameters leave, and the rule that a reviewer reads beside each."""

from __future__ import annotations

from collections.abc import Sequence

from generator.grouping.observability import STEMS
from generator.grouping.scalars import Scalar
from generator.robot.description import FIXED, PRISMATIC, REVOLUTE, Joint

#: First to leave first, as SYMORO chooses (Gautier and Khalil 1990): YY, MZ and M behind a revolute joint.
_REVOLUTE = ("Ia", "M", "MZ", "YY", "XX", "XY", "XZ", "YZ", "MY", "MX", "ZZ", "Off")
#: The inertia tensor behind a prismatic joint.
_PRISMATIC = ("Ia", "XX", "XY", "XZ", "YY", "YZ", "ZZ", "MZ", "MY", "MX", "M", "Off")

#: Why one leaves that no motion shows by itself: it acts in no torque, or as a part of the bodies before.
_UNSEEN = "the joints up to this one do not move the body in a way that shows it"
_CARRIED = "this joint's motion does not show it: it acts as a part of the antecedent"


def elimination_order(joint: Joint) -> list[int]:
    """Indices of the twelve parameters, first to be eliminated first."""
    return [STEMS.index(stem) for stem in (_PRISMATIC if joint.sigma == PRISMATIC else _REVOLUTE)]


def told(rule: str, into: Sequence[str]) -> str:
    """The rule of a parameter that went ``into`` base parameters, if any."""
    if rule == _UNSEEN:
        return _CARRIED if into else _UNSEEN
    return rule if into else f"{rule}, where no torque shows them"


def rule_of(joint: Joint, pivot: int, vector: Sequence[Scalar]) -> str:
    """Why the parameter ``pivot`` of a joint leaves, read off the combination that is invisible."""
    stem = STEMS[pivot]
    partners = [STEMS[k] for k, coefficient in enumerate(vector) if coefficient and k != pivot]
    if joint.sigma == FIXED:
        return "fixed joint: the whole body belongs to its antecedent"
    if stem == "Ia":
        return f"rotor inertia acts as {' and '.join(partners)} of the same joint"
    if joint.sigma == REVOLUTE and stem in ("YY", "MZ", "M") and partners in ([], ["XX"]):
        return "revolute joint: YY (with XX), MZ and M act as parts of the antecedent"
    if joint.sigma == PRISMATIC and stem in ("XX", "XY", "XZ", "YY", "YZ", "ZZ") and not partners:
        return "prismatic joint: the body does not turn, its tensor belongs to the antecedent"
    if not partners:
        return _UNSEEN
    return f"the joints before this one show it only together with {', '.join(partners)}"
