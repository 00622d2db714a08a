"""What stays unexplained: joints on which a model with all findings leaves more than noise, or runs contradict it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from identification.diagnosis.columns.hypothesis import Key
from identification.diagnosis.runs.stated_elasticity import names_of_backlash, stated
from identification.diagnosis.search.loop import Search
from identification.diagnosis.search.selection import Choice
from identification.diagnosis.verdict.contradiction import Contradicted, pulled
from identification.diagnosis.verdict.crossed import Crossed, crossed
from identification.diagnosis.verdict.drifting import drifting
from identification.diagnosis.verdict.gap_crossings import BOUNCED
from identification.diagnosis.verdict.lack_of_fit import Lack
from identification.diagnosis.verdict.other_joints import following_others
from identification.diagnosis.verdict.overlooked import untested, untold
from identification.diagnosis.verdict.ripples import Ripple, ripples
from identification.diagnosis.verdict.tones import Tone, tones
from identification.diagnosis.verdict.trial import Trial
from identification.diagnosis.verdict.where import Where, located
from identification.residuals import rms

#: Why something stays unexplained where a residual does not say so.
VALUES, AMPLITUDES = "values", "amplitudes"

#: What may stay unexplained of any law, in parts of what was explained on the joint.
_PART = 0.3
#: Factor by which the size of a torque and the time of a fall may differ about a gap; and the part of a backlash's size
#: on the joint where it is largest, beside the noise, that another joint feels.
_SAME, _FELT = 1.3, 0.1


@dataclass(frozen=True)
class Unexplained:
    """Joints that lack something (``lacks``), and ``where`` that is most, None where it was not asked.

    ``reason`` is what alone says so: other ``VALUES`` than are known, or ``AMPLITUDES`` that do not hold; else empty.
    ``bouncing`` are the joints, by number, that feel a link bounce in a gap of the file or of a finding. ``notes`` tell
    what else speaks for it.
    """

    lacks: tuple[Lack, ...]
    where: Where | None
    reason: str = ""
    bouncing: tuple[int, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def missing(self) -> bool:
        """Whether anything stays unexplained."""
        return bool(self.lacks) or self.reason == VALUES


#: Of a diagnosis that only locates.
NOT_JUDGED = Unexplained((), None)


def unexplained(
    found: Search,
    gone: Sequence[Choice],
    trial: Trial | None,
    last: Where,
    disagreeing: Collection[Key],
    other: Sequence[Contradicted],
) -> Unexplained:
    """What a search leaves, of whose model ``last`` tells where its residual is.

    In this order: large residuals, which beside what was found may be small, but not on joints of what was found and is
    ``gone``; what passes by; torques that drift or sway by themselves; findings, by effect and joint, on whose
    amplitude the runs are ``disagreeing``; where nothing was found what noise may hide, friction of two variables, and
    ripples, which are told beside large residuals too; what is ``gone`` of which the runs that test keep far more than
    noise; and parameters that have ``other`` values than are known.
    """
    bounces, loose, explained = _bounces(found), _loose(found), _explained(found) | _taken_back(found, gone)
    stays = {one.joint: _PART * float(np.hypot(explained[one.joint], bounces.get(one.joint, 0.0))) for one in last.lack}
    stays |= {number: max(stays[number], BOUNCED * explained[number]) for number in loose}
    large = [one for one in last.lack if _large(one, stays[one.joint])]
    passed = {} if large else _passed(found)
    overlooked = {} if large or passed else _drifting(found) | _swaying(found)
    doubtful = [] if large or passed or overlooked else _doubtful(found, last, disagreeing)
    nothing = not (large or passed or overlooked or doubtful or found.choices)
    if nothing:
        overlooked = _overlooked(found, trial)
    rippling = {} if passed or overlooked or doubtful else _rippling(found)
    crossing = _crossing(found) if nothing and not overlooked else {}
    unseen = crossing or rippling if nothing else {}
    contradicting = {} if not nothing or overlooked or unseen else _contradicting(found, trial, gone)
    lacks = large or doubtful or [last.lack[k] for k in passed or overlooked or unseen or contradicting]
    where = located(last, lacks)
    if passed:
        where = _told_by(passed, where, "time", passed[next(iter(passed))])
    elif overlooked:
        where = _told_by(overlooked, where, "time", "changes with time or from run to run")
    elif unseen:
        where = _told_by(unseen, where, "q", "where no mean shows it")
    elif contradicting:
        where = _told_by(contradicting, where, "qd", "close to standstill")
    reason = AMPLITUDES if doubtful else ""
    pulling = None if lacks or found.choices else pulled(found, other)
    if pulling is not None:
        where = replace(where, joint=last.lack[pulling].joint, region="by other values than are known")
        reason = VALUES
    passing = (one.told(found.bank.robot) for one in found.passing)
    told = (*passing, *overlooked.values(), *crossing.values(), *rippling.values(), *contradicting.values())
    if large:
        told += tuple(following_others(found, last, large))
    return Unexplained(tuple(lacks), where, reason, (*bounces, *loose), told)


def _bounces(found: Search) -> dict[int, float]:
    """By the joint's number, the rms of the file's backlash beside the noise's, of which no file tells all: how a link
    bounces the smallest error changes.
    """
    bank, result = found.bank, {}
    for one in stated(bank.robot):
        if one.gap:
            numbers = [bank.base.index(name) for name in names_of_backlash(one.number)]
            weights = {number: found.weights[number] for number in numbers}
            result[one.number] = rms(bank.left(one.k, {}) - bank.left(one.k, weights))
    return result


def _loose(found: Search) -> list[int]:
    """Numbers of the joints that feel a backlash which was found, its gap told alike twice."""
    weights, numbers = found.weights, found.bank.robot.numbers
    result = []
    for choice in found.choices:
        one, sizes = choice.evidence.variant, choice.evidence.sizes
        for c, number in zip(one.coefficients, one.columns, strict=True):
            if one.hypothesis.effect == "backlash" and c.name in one.hypothesis.twice:
                shape, power = one.hypothesis.twice[c.name]
                if abs(np.log(max(weights[number], 1e-300) / one.shape[shape] ** power)) < np.log(_SAME):
                    result += [numbers[k] for k, size in sizes.items() if size > _FELT * max(sizes.values())]
    return result


def _explained(found: Search) -> dict[int, float]:
    """By the joint's number, the rms beside the noise's of what was found there."""
    bank, result = found.bank, {}
    for k, joint in enumerate(bank.robot.moving):
        first, last = bank.left(k, found.start), bank.left(k, found.weights)
        result[joint.number] = float(np.sqrt(max(float(first @ first - last @ last), 0.0) / max(len(first), 1)))
    return result


def _taken_back(found: Search, gone: Sequence[Choice]) -> dict[int, float]:
    """Nothing, by the joint's number, where findings are ``gone``: what stands in their place explains too much."""
    numbers = found.bank.robot.numbers
    return {numbers[k]: 0.0 for one in gone for k in one.evidence.variant.coordinates}


def _large(lack: Lack, stays: float) -> bool:
    """Whether what a joint's model lacks is more than noise, and more than ``stays`` beside what was explained there,
    or what the file explains by a link that bounces.
    """
    return lack.burst is not None or (lack.told and lack.size > stays)


def _doubtful(found: Search, last: Where, disagreeing: Collection[Key]) -> list[Lack]:
    """Of the joints on which findings act of whose amplitude the runs disagree."""
    return [last.lack[k] for one in found.variants if one.key in disagreeing for k in one.coordinates]


def _overlooked(found: Search, trial: Trial | None) -> dict[int, str]:
    """By coordinate, the worst first, why something is missing though nothing was found, in words."""
    numbers = found.bank.robot.numbers
    most = untold(found, found.start)
    tested = {} if trial is None else untested(found, trial)
    return {
        k: f"most of how the torque of joint {numbers[k]} varies follows from nothing, too slowly for noise"
        for k in _worst_first(most)
    } | {
        k: f"the runs that test keep {tested[k]:.2g} times the noise on joint {numbers[k]}, the others do not: what is "
        "missing there changes from run to run, or with time"
        for k in _worst_first(tested)
        if k not in most
    }


def _contradicting(found: Search, trial: Trial | None, gone: Sequence[Choice]) -> dict[int, str]:
    """By coordinate, the worst first, on which findings are ``gone`` though the runs that test keep far more than noise
    close to standstill, where else nothing is asked of them; in words.
    """
    if trial is None:
        return {}
    named = {k: one.evidence.variant.hypothesis.title for one in gone for k in one.evidence.variant.coordinates}
    kept, numbers = untested(found, trial, named), found.bank.robot.numbers
    return {
        k: f"the runs that test keep {kept[k]:.2g} times the noise on joint {numbers[k]}, most of it close to "
        f"standstill: {named[k]} of the values that were found does not explain it, but something there is missing"
        for k in _worst_first(kept)
        if k in named
    }


def _passed(found: Search) -> dict[int, str]:
    """By coordinate, what lasts longest first, how often and when something passes by, in words."""
    result: dict[int, str] = {}
    often = Counter(one.k for one in found.passing)
    for one in sorted(found.passing, key=lambda one: one.begins - one.ends):
        times = "once, from" if often[one.k] == 1 else f"{often[one.k]} times, longest from"
        result.setdefault(one.k, f"{times} {one.when}")
    return result


def _drifting(found: Search) -> dict[int, str]:
    """By coordinate, the worst first, whose torque drifts, in words."""
    sizes, numbers = drifting(found, found.weights), found.bank.robot.numbers
    return {
        k: f"the torque of joint {numbers[k]} drifts while its motion repeats, by {sizes[k]:.2g} times what else "
        "differs between the periods"
        for k in _worst_first(sizes)
    }


def _swaying(found: Search) -> dict[int, str]:
    """By coordinate, the worst first, whose torque oscillates by itself, in words."""
    return _of_parts(
        found,
        tones(found, found.weights),
        "{percent:.0f} % of what differs between the periods of joint {joint.number} is an oscillation of "
        "{one.frequency:.3g} Hz that does not follow the motion",
    )


def _rippling(found: Search) -> dict[int, str]:
    """By coordinate, the worst first, whose torque ripples along the range at a period of its own, in words."""
    return _of_parts(
        found,
        ripples(found, found.weights),
        "{percent:.0f} % of what is left of joint {joint.number} is a ripple along its range, every {one.length:.3g} "
        "{joint.position_unit}{one.or_finer}, that no finding explains",
    )


def _crossing(found: Search) -> dict[int, str]:
    """By coordinate, the worst first, whose friction follows two variables at once, in words."""
    return _of_parts(
        found,
        crossed(found, found.weights),
        "{percent:.0f} % of what is left of joint {joint.number} is friction that follows {one.follows}",
    )


def _of_parts(found: Search, seen: Mapping[int, Tone | Ripple | Crossed], words: str) -> dict[int, str]:
    """By coordinate, the largest part first, what was ``seen`` in ``words`` with the joint, the one and its percent."""
    moving = found.bank.robot.moving
    order = _worst_first({k: one.part for k, one in seen.items()})
    return {k: words.format(joint=moving[k], one=seen[k], percent=100 * seen[k].part) for k in order}


def _worst_first(sizes: Mapping[int, float]) -> list[int]:
    return sorted(sizes, key=lambda k: -sizes[k])


def _told_by(said: Mapping[int, str], after: Where, variable: str, region: str) -> Where:
    """On the joint of which most was ``said``, where no mean over a variable says it."""
    return replace(after, joint=after.lack[next(iter(said))].joint, variable=variable, region=region, shares={})
