"""Joints of which the runs have too few rows for what is known to act there: they do not tell noise from the model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from generator.review.words import listed
from generator.robot.description import Robot
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.noise.may_act import enough
from identification.diagnosis.search.likely import common
from identification.diagnosis.search.loop import Search
from identification.diagnosis.search.selection import Choice
from identification.diagnosis.verdict.finding import TENTATIVE, Finding

#: Size of an effect where it is largest, in parts of the noise's rms, from which it is named on such a joint.
_LEAST = 0.75

#: Rows in all runs and number of base parameters that act, by coordinates of which the rows are too few.
Few = Mapping[int, tuple[int, int]]


def few_rows(bank: Bank) -> Few:
    """Of the joints of a bank; nothing where all have rows enough."""
    result = {}
    for k in range(bank.dof):
        rows, model = bank.counts(k)
        if rows and not enough(rows, model):
            result[k] = rows, model
    return result


def notes(few: Few, robot: Robot, small: Sequence[Choice]) -> list[str]:
    """What is to be told of the joints of few rows, and of what was ``small`` there."""
    said = [f"{rows} for {model} on joint {robot.numbers[k]}" for k, (rows, model) in few.items()]
    if not said:
        return []
    told = [
        f"rows are too few for the base parameters that act there, {listed(said)}: noise holds part of the model, and "
        "only what is about as large as noise, or what nearly every robot has, is named"
    ]
    if small:
        left_out = listed([one.evidence.variant.hypothesis.named for one in small])
        told.append(
            f"left out there, smaller than {_LEAST:g} of the noise or larger than is believed: {left_out}; "
            "other values on the same joints may contain a part of it"
        )
    return told


def without_small(found: Search, few: Few) -> tuple[Search, list[Choice]]:
    """The search without the choices that are small beside the noise of joints of few rows, or not believed, and that
    not every robot has; and those.
    """
    kept: list[Choice] = []
    small: list[Choice] = []
    for one in found.choices:
        there = not few.keys().isdisjoint(one.evidence.variant.joints) and not common(one.evidence.variant)
        doubtful = one.evidence.size < _LEAST or not one.evidence.believed
        (small if there and doubtful else kept).append(one)
    return (found.keeping(kept), small) if small else (found, small)


def doubted(few: Few, robot: Robot, named: Sequence[Finding], small: Sequence[Choice]) -> tuple[Finding, ...]:
    """Findings, tentative where they act on a joint of few rows on which what was ``small`` was left out of the fit."""
    beside = {k for one in small for k in one.evidence.variant.joints} & few.keys()
    numbers = {robot.numbers[k] for k in beside}
    return tuple(
        one if numbers.isdisjoint(one.amplitude) else replace(one, status=TENTATIVE, sure=False) for one in named
    )
