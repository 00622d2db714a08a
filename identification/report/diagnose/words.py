"""A diagnosis in sentences."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from generator.review.words import listed, unit
from identification.diagnosis.diagnosis import KNOWN, NAMED, NOTHING
from identification.diagnosis.finding import FIRM, Finding
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
    """A p-value in words."""
    return f"less than {plain(_LEAST_P, 1)}" if p < _LEAST_P else plain(p, 2)


def verdict(subject: Subject) -> Iterator[str]:
    """What is missing and where, in one paragraph."""
    found = subject.found
    if found.verdict == NOTHING:
        yield "The model explains these runs: nothing in the library of effects improves it beyond chance,"
        yield "and what is left on each joint is noise."
        return
    if not found.findings:
        where = found.before
        yield "Something is missing in the model, and no effect of the library explains it."
        yield f"It is on joint {where.joint}, {_ordered(where.variable, where.region)}."
        return
    if len(found.findings) > 1:
        yield f"The model lacks {len(found.findings)} effects."
    for one in found.findings:
        yield from _finding(subject, one)
    if found.verdict != NAMED:
        after = found.after
        yield f"That is not all: joint {after.joint or _largest(subject)} keeps more than noise,"
        yield f"{_ordered(after.variable, after.region)}, so that what is named here is tentative."


def _finding(subject: Subject, one: Finding) -> Iterator[str]:
    yield f"On {joints(one.joints)} the model lacks {one.hypothesis.title}: {values(one)}."
    amplitude = [
        f"{plain(rms, 3)}\u00a0{unit(subject.torque_units[number])} on joint {number}"
        for number, rms in sorted(one.amplitude.items(), key=lambda pair: -pair[1])[:3]
    ]
    yield f"Its torque is {listed(amplitude)} (rms),"
    yield f"of which {plain(one.evidence.size, 2)} times the noise cannot be laid to anything else in the model."


def certainty(subject: Subject) -> Iterator[str]:
    """How sure that is."""
    for one in subject.found.findings:
        e = one.evidence
        yield f"{one.hypothesis.title[:1].upper()}{one.hypothesis.title[1:]} on {joints(one.joints)} is {one.status}:"
        yield f"chance would explain as much with a probability of {chance(e.p)}, and it lowers the sum of squares of"
        yield f"the runs that were not fitted by {plain(e.validation, 3)}, in variances of the noise."
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
        yield f"On the untouched runs joint {number} is left with {plain(one.relative_after, 3)}\u202f% of its torque's"
        yield f"spread, instead of {plain(one.relative_before, 3)}\u202f%;"
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


def _ordered(variable: str, region: str) -> str:
    if not variable:
        return "and no variable orders it"
    return f"over {variable}" + (f" ({region})" if region else "")


def _largest(subject: Subject) -> int:
    return max(subject.found.after.lack, key=lambda one: one.size).joint
