"""A diagnosis in sentences."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from generator.review.words import listed, unit
from identification.diagnosis.diagnosis import KNOWN, LOCATED, NAMED, NOTHING
from identification.diagnosis.finding import FIRM, Finding
from identification.diagnosis.where import Where
from identification.report.diagnose.subject import Subject
from identification.report.numbers import plain

#: p-values below this are printed as such.
_LEAST_P = 1e-12


def joints(numbers: Sequence[int]) -> str:
    """``joint 2``, ``joints 5 and 6``, or the whole robot."""
    if not any(numbers):
        return "the whole robot"
    return f"joint{'s' if len(numbers) > 1 else ''} {listed(map(str, numbers))}"


def values(one: Finding) -> str:
    """Parameters with their uncertainty, then the shape: ``Fs2 = 5.1 ± 0.1 N m, vs = 0.15 rad/s``."""
    told = []
    for name, value in one.parameters.items():
        if value.value is not None:
            text = f"{name} = {plain(value.value, 4)} ± {plain(value.std, 2)}"
            told.append(text if value.unit == "1" else f"{text}\u00a0{unit(value.unit)}")
    units = {shape.name: shape.unit for shape in one.hypothesis.shapes}
    for name, number in one.shape.items():
        symbol = units.get(name, "1")
        text = f"{name} = {plain(number, 4)}"
        told.append(text if symbol == "1" else f"{text}\u00a0{unit(symbol)}")
    return ", ".join(told)


def chance(p: float) -> str:
    """A p-value."""
    return f"<\u202f{plain(_LEAST_P, 1)}" if p < _LEAST_P else plain(p, 2)


def _probability(p: float) -> str:
    return f"below {plain(_LEAST_P, 1)}" if p < _LEAST_P else f"of {plain(p, 2)}"


def verdict(subject: Subject) -> Iterator[str]:
    """What is missing and where, in one paragraph."""
    found = subject.found
    if found.verdict == NOTHING:
        yield "The model explains these runs: nothing in the library of effects improves it beyond chance,"
        yield "and what is left on each joint is noise."
        return
    if found.verdict == NAMED:
        yield f"The model lacks {_named(found.findings)}."
        return
    if found.verdict == LOCATED:
        yield "This was only to look where model and measurement disagree: nothing was named."
        if found.before.joint:
            yield f"Joint {found.before.joint} keeps more than noise, {_ordered(subject, found.before)}."
        else:
            yield "No joint keeps more than noise."
        return
    where = found.after
    yield "Something is missing in the model that no effect of the library explains:"
    yield f"joint {where.joint} keeps more than noise, {_ordered(subject, where)}."
    if found.findings:
        yield f"What is named is therefore tentative: {_named(found.findings)}."


def finding(subject: Subject, one: Finding) -> Iterator[str]:
    """How much, and how sure, of one effect."""
    yield f"{one.hypothesis.title[:1].upper()}{one.hypothesis.title[1:]} on {joints(one.joints)}: {values(one)}."
    amplitude = [
        f"{plain(rms, 3)}\u00a0{unit(subject.torque_units[number])} on joint {number}"
        for number, rms in sorted(one.amplitude.items(), key=lambda pair: -pair[1])[:3]
    ]
    yield f"Its torque is {listed(amplitude)} (rms); what of it nothing else in the model can stand for is"
    yield f"{plain(one.evidence.size, 2)} times the noise."
    e = one.evidence
    yield f"It is {one.status}: chance would explain as much with a probability {_probability(e.p)}, and the sum of"
    yield f"squares of runs that were not fitted falls by {plain(e.validation, 3)}, in variances of the noise."
    if one.alternatives:
        others = [f"{other.title} on {joints(other.joints)}" for other in one.alternatives]
        yield f"This data cannot tell it from {listed(others)}."
    elif one.status == FIRM:
        yield "No other effect of the library would do in its place."
    if not one.homogeneous:
        yield "Its size differs between the runs: it drifts, or is chance."


def change(subject: Subject) -> Iterator[str]:
    """What naming it changed on the untouched runs."""
    tried = subject.tried
    if not tried or not subject.found.findings:
        return
    acted = [number for number in subject.found.findings[0].amplitude if number in tried]
    for number in acted[:1] or list(tried)[:1]:
        one = tried[number]
        before, after = (plain(value.relative_to_mean, 3) for value in (one.before, one.after))
        yield f"On the untouched runs joint {number} is left with {after}\u202f% of its torque's spread, instead of"
        yield f"{before}\u202f%;"
        yield f"noise alone would leave about {plain(one.relative_floor, 2)}\u202f%."
        if one.closed is not None:
            yield f"{plain(100 * one.closed, 3)}\u202f% of the gap between the two, in squares, is closed."


def mode(subject: Subject) -> str:
    """What the mode can and cannot see."""
    if subject.found.mode == KNOWN:
        return "Parameters were held near what was known of them, so that effects they could stand for are seen too."
    return (
        "All parameters were fitted together with the effects. What they can stand for cannot be seen so; a parameter"
        " set that is known beforehand (--prior) would show it."
    )


def shortened(subject: Subject, text: str) -> str:
    """A text with the runs' names without their folders."""
    for run in subject.found.runs:
        text = text.replace(run.sampled.run.name, Path(run.sampled.run.name).name)
    return text


def _named(found: Sequence[Finding]) -> str:
    return listed(f"{one.hypothesis.title} on {joints(one.joints)}" for one in found)


def _ordered(subject: Subject, where: Where) -> str:
    if not where.variable:
        return "and no variable orders it"
    return f"over {where.variable}" + (f" ({shortened(subject, where.region)})" if where.region else "")
