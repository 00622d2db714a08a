"""What is told of joints of few rows, and what that makes of findings there."""

from __future__ import annotations

from collections.abc import Sequence

from generator.robot.description import Robot
from generator.words import listed
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.search.few_rows import LEAST, Few
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.finding import Finding

#: Why what is found on a joint of few rows is not sure.
_BESIDE = "rows are too few on its joint, and something small was left out there"


def left_out(found: Search) -> list[Variant]:
    """What would have been taken beside the choices, were it not small there: on each joint what explains most."""
    weighed = found.weighing.evidence(found.variants) if found.weighing.few else []
    result: list[Variant] = []
    told: set[int] = set()
    for one in weighed:
        there = found.weighing.few.keys() & {*one.variant.coordinates}
        if one.small and not there <= told:
            result.append(one.variant)
            told |= there
    return result


def notes(few: Few, robot: Robot, small: Sequence[Variant]) -> list[str]:
    """What is to be told of the joints of few rows, and of what was ``small`` there."""
    said = [f"{rows} for {model} on joint {robot.numbers[k]}" for k, (rows, model) in few.items()]
    if not said:
        return []
    told = [
        f"rows are too few for the base parameters that act there, {listed(said)}: noise may hold part of the model, "
        "and only what is about as large as noise, or what nearly every robot has, is named"
    ]
    if small:
        named = listed([one.hypothesis.named for one in small])
        told.append(
            f"left out there, smaller than {LEAST:g} of the noise or larger than is believed: {named}; "
            "other values on the same joints may contain a part of it"
        )
    return told


def doubted(few: Few, robot: Robot, named: Sequence[Finding], small: Sequence[Variant]) -> tuple[Finding, ...]:
    """Findings, tentative where they act on a joint of few rows on which what was ``small`` was left out of the fit."""
    beside = {k for one in small for k in one.coordinates} & few.keys()
    numbers = {robot.numbers[k] for k in beside}
    return tuple(one if numbers.isdisjoint(one.amplitude) else one.doubted(_BESIDE, sure=False) for one in named)
