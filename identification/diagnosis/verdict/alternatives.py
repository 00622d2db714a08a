"""What may stand in the place of a finding, and the experiment that tells the two apart."""

from __future__ import annotations

from collections.abc import Sequence

from generator.effects.library import library
from generator.words import numbered
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import Hypothesis, asked_for
from identification.diagnosis.search.evidence import Evidence
from identification.diagnosis.search.selection import Choice
from identification.diagnosis.search.whole_orders import UNSURE
from identification.diagnosis.verdict.finding import Alternative

#: Stand for whatever makes a ripple, a torque of the position, or friction, or places the links elsewhere, that is none
#: of the library's; and for a body that has another value than the known one.
OTHER_RIPPLE, OTHER_TORQUE, OTHER_FRICTION = "other_ripple", "other_torque", "other_friction"
OTHER_GEOMETRY, OTHER_BODY = "other_geometry", "other_body"

#: Those of motors one by one, and of all alike.
_GAIN = "torque_gain"


def alternatives(mine: Hypothesis, one: Choice, chosen: Sequence[Variant], free: bool) -> tuple[Alternative, ...]:
    """What explains as much in the place of ``mine``, which is that of a choice among all that were ``chosen`` in a
    ``free`` fit or one with known parameters. Of several gains the common part is none: it says the same of all.
    """
    gains = [each for each in chosen if each.hypothesis.effect == _GAIN]
    same = _GAIN if len(gains) > 1 and mine.effect == _GAIN else ""
    others = [other for other in one.alternatives if other.variant.hypothesis.effect != same]
    found = [_alternative(mine, other, free) for other in others]
    if one.odds < UNSURE:
        title = "ripple whose order is no whole number"
        turns = "more turns of the joint in one run: they tell the order more closely"
        found.append(outside(OTHER_RIPPLE, title, mine.numbers, one.evidence, turns))
    return tuple(found)


def outside(effect: str, title: str, joints: tuple[int, ...], evidence: Evidence, experiment: str) -> Alternative:
    """Something of no law of the library that explains as much."""
    return Alternative(effect, title, joints, f"{title} on {numbered('joint', joints)}", evidence.score, experiment)


def _alternative(mine: Hypothesis, other: Evidence, free: bool) -> Alternative:
    one = other.variant.hypothesis
    return Alternative(
        one.effect, one.title, one.numbers, one.named, other.score, asked_for(separating(mine, one), free)
    )


def separating(mine: Hypothesis, other: Hypothesis) -> str:
    """The experiment that tells two effects apart, in words."""
    return (
        mine.separating.get(other.effect)
        or other.separating.get(mine.effect)
        or _resemblance(mine.effect, other.effect)
        or _resemblance(other.effect, mine.effect)
        or other.would_show
        or "more motion of the joint: other ranges, speeds and loads"
    )


def _resemblance(one: str, other: str) -> str:
    return effect.resembles.get(other, "") if (effect := library().get(one)) else ""
