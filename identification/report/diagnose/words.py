"""A diagnosis in sentences."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from generator.words import listed, minus, numbered, unit
from identification.diagnosis.diagnosis import KNOWN, LOCATED, NAMED, NOTHING, Diagnosis
from identification.diagnosis.runs.played import together
from identification.diagnosis.verdict.contradiction import Contradicted
from identification.diagnosis.verdict.finding import FIRM, Finding, Told
from identification.diagnosis.verdict.lack_of_fit import CHANCE
from identification.diagnosis.verdict.patchwork import PATCHED
from identification.diagnosis.verdict.unexplained import AMPLITUDES, VALUES
from identification.diagnosis.verdict.where import Where
from identification.report.diagnose.subject import Subject
from identification.report.numbers import plain

#: p-values below this are printed as such.
_LEAST_P = 1e-12


def values(one: Finding) -> str:
    """Parameters with their uncertainty, then the shape: ``Fs2 = 5.1 ± 0.1 N m, vs = 0.15 ± 0.01 rad/s``."""
    return ", ".join(map(_value, one.told))


def _value(one: Told) -> str:
    symbol = "" if one.unit == "1" else f"\u00a0{unit(one.unit)}"
    return f"{one.name} = {minus(one.text(symbol, '±'))}"


def alike(found: Sequence[Finding]) -> list[list[Finding]]:
    """Findings together of which the same is to be said but for joints and numbers: an effect on several joints."""
    groups: dict[tuple[object, ...], list[Finding]] = {}
    for one in found:
        own = one.joints if one.alternatives or not one.homogeneous or not one.determined else ()
        groups.setdefault((one.hypothesis.effect, one.hypothesis.title, one.doubts, own), []).append(one)
    return [sorted(group, key=lambda one: one.joints) for group in groups.values()]


def named(group: Sequence[Finding]) -> str:
    """Findings that are alike, by their title and joints."""
    if len(group) == 1:
        return group[0].hypothesis.named
    numbers = (number for one in group for number in one.joints)
    return f"{group[0].hypothesis.title} on {numbered('joint', numbers)}"


def capitalised(text: str) -> str:
    """As a sentence begins."""
    return f"{text[:1].upper()}{text[1:]}"


def chance(p: float) -> str:
    """A p-value."""
    return f"<\u202f{plain(_LEAST_P, 1)}" if p < _LEAST_P else plain(p, 2)


def _probability(p: float) -> str:
    return f"below {plain(_LEAST_P, 1)}" if p < _LEAST_P else f"of {plain(p, 2)}"


def verdict(subject: Subject) -> Iterator[str]:
    """What is missing and where, in one paragraph."""
    found = subject.found
    if found.verdict == NOTHING:
        yield "The model explains these runs: no effect of the library that is large enough to be named improves it"
        hardly = "hardly more than " if any(one.p < CHANCE for one in found.after.lack) else ""
        yield f"beyond chance, and what is left on each joint is {hardly}noise."
        yield from _otherwise(found.contradicted)
        return
    if found.verdict == NAMED:
        lacks = "lacks" if any(one.sure for one in found.findings) else "may lack"
        yield f"The model {lacks} {_named(found.findings)}."
        yield from _otherwise(found.contradicted)
        return
    if found.verdict == LOCATED:
        yield "This was only to look where model and measurement disagree: nothing was named."
        if found.before.joint:
            yield f"Joint {found.before.joint} keeps more than noise, {_ordered(found.before)}."
        else:
            yield "No joint keeps more than noise."
        return
    if found.reason == VALUES:
        others = listed(one.name for one in found.contradicted)
        yield f"The model explains these runs with other values than are known of {others}, by far more than their"
        yield "uncertainty: those are wrong, or stand for something that is missing, most of it on joint"
        yield f"{found.after.joint}."
        return
    yield "Something is missing in the model that no effect of the library explains well enough to be named:"
    if found.reason == AMPLITUDES:
        off = (f"the size of {one.hypothesis.named} {one.disagreement}" for one in found.findings if one.disagreement)
        yield f"{listed(off)}."
    elif found.reason == PATCHED:
        yield f"joint {found.after.joint} takes several effects of which none is firm; together they may stand for one"
        yield "that the library does not have."
    else:
        yield f"joint {found.after.joint} keeps more than noise, {_ordered(found.after)}."
        if found.after.event not in ("", found.after.region):
            yield f"Something happens there {found.after.event}."
    if found.findings:
        therefore = "" if found.reason == PATCHED else " therefore tentative"
        yield f"The findings below are{therefore}: {_named(found.findings)}."


def _otherwise(contradicted: Sequence[Contradicted]) -> Iterator[str]:
    """What is not as it is known."""
    if contradicted:
        others = listed(one.name for one in contradicted)
        yield f"But these runs want other values than are known of {others}, by far more than their uncertainty."


def finding(subject: Subject, group: Sequence[Finding]) -> Iterator[str]:
    """How much, and how sure, of one effect, on one joint or on several."""
    one, several = group[0], len(group) > 1
    yield f"{capitalised(named(group))}: {', '.join(map(values, group))}."
    if not one.determined:
        yield "The runs tell its torque, but not these values one by one: others make nearly the same."
    amplitude = [
        f"{plain(rms, 3)}\u00a0{unit(subject.torque_units[number])} on joint {number}"
        for each in group
        for number, rms in sorted(each.amplitude.items(), key=lambda pair: -pair[1])[:3]
    ]
    sizes = sorted(each.evidence.size for each in group)
    size = f"{plain(sizes[0], 2)} to {plain(sizes[-1], 2)}" if several else plain(sizes[0], 2)
    yield f"Its torque is {listed(amplitude)} (rms); what of it nothing else in the model can stand for is"
    yield f"{size} times the noise."
    p, validation = max(each.evidence.p for each in group), min(each.evidence.validation for each in group)
    least = " or more for each joint" if several else ""
    yield f"It is {one.status}{_because(one.doubts)}. Chance would explain as much with a probability"
    yield f"{_probability(p)}, and the sum of squares of runs that were not fitted falls by"
    yield f"{plain(validation, 3)}{least}, in variances of the noise."
    if one.alternatives:
        others = [other.named for other in one.alternatives]
        yield f"This data cannot tell it from {listed(others)}."
    elif one.status == FIRM:
        yield f"No other effect of the library is as likely in its place{' on any of them' if several else ''}."
    elif not one.sure:
        yield "Noise cannot be told from the model's faults here, so this may be noise alone."
    elif subject.found.verdict == NAMED:
        yield "Such a torque acts for certain; that this effect makes it is not certain."
    if one.disagreement:
        yield f"Its size {one.disagreement}: it drifts, or something else makes it."


def _because(doubts: Sequence[str]) -> str:
    return f" because {'; and because '.join(doubts)}" if doubts else ""


def change(subject: Subject) -> Iterator[str]:
    """What naming it changed on the runs that test."""
    tried = subject.tried
    if not tried or subject.mended is None or not subject.mended.written:
        return
    totals = [together(played).total.relative_to_mean for played in (subject.mended.before, subject.mended.after)]
    was, now = (f"{plain(one, 3)}\u202f%" for one in totals)
    yield f"On the {subject.found.roles.tested} {now} of the torques' spread is left, instead of {was}."
    acted = [number for number in subject.mended.written[0].amplitude if number in tried]
    for number in acted[:1] or list(tried)[:1]:
        one = tried[number]
        before, after = (plain(value.relative_to_mean, 3) for value in (one.before, one.after))
        yield f"Joint {number} is left with {after}\u202f%, instead of {before}\u202f%;"
        if one.after.relative_to_mean <= one.relative_floor:
            beside = _beside(subject.found, number)
            yield f"that is not more than the noise that was measured on the fitted runs{beside}."
            continue
        yield f"noise alone would leave about {plain(one.relative_floor, 2)}\u202f%."
        if one.closed is not None:
            yield f"{plain(100 * one.closed, 3)}\u202f% of the gap between the two, in squares, is closed."


def _beside(found: Diagnosis, number: int) -> str:
    """What the fitted runs keep on a joint beside the noise that was measured on them, which is not held against it."""
    lack = next(one for one in found.after.lack if one.joint == number)
    return f", though these keep {plain(lack.size, 2)} times that rms beside it" if lack.told else ""


def mode(subject: Subject) -> str:
    """What the mode can and cannot see."""
    if subject.found.mode == KNOWN:
        return "Parameters were kept near their known values, so that effects they could stand for are seen too."
    return (
        "All parameters were fitted together with the effects. What they can stand for cannot be seen so; a parameter"
        " set that is known beforehand (--prior) would show it."
    )


def _named(found: Sequence[Finding]) -> str:
    return listed(_with_alternatives(group) for group in alike(found))


def _with_alternatives(group: Sequence[Finding]) -> str:
    others = [other.named for other in group[0].alternatives]
    return f"{named(group)} (or {' or '.join(others)})" if others else named(group)


def _ordered(where: Where) -> str:
    return where.words or "and no variable orders it"
