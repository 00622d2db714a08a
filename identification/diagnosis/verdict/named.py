"""The choices of a search as findings."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.bank import Variant, columns_of
from identification.diagnosis.columns.hypothesis import Key
from identification.diagnosis.noise.may_act import maps_taken
from identification.diagnosis.search.evidence import Evidence
from identification.diagnosis.search.likely import pulls
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.alternatives import alternatives
from identification.diagnosis.verdict.doubts import (
    beside_any_torque,
    beside_drive_trains,
    beside_warming,
    doubted,
    doubted_drive_train,
)
from identification.diagnosis.verdict.finding import Finding
from identification.diagnosis.verdict.gap_crossings import left_between
from identification.diagnosis.verdict.shape_reach import reaching
from identification.diagnosis.verdict.shape_uncertainty import apart, deviations
from identification.outcome import Value

#: Size of a finding, in parts of the noise's rms, below which it is not firm where nothing repeats: the noise is then
#: not known apart from the model. Where rows are too few to take what may act out of it as well.
_APERIODIC, _SHORT = 0.5, 1.0


def findings(
    found: Search, firm: bool, disagreements: Mapping[Key, str], left: Mapping[int, float]
) -> tuple[Finding, ...]:
    """The choices of a search, the one with the most evidence first; all tentative where not ``firm``, and each that
    any other torque may be.

    ``disagreements`` tell in words, by effect and joint, how the runs disagree on an amplitude. ``left`` is what stays
    beyond chance on joints, by number, beside the noise.
    """
    columns = columns_of(found.variants)
    solution, _ = found.weighing.fitted(found.variants)
    std, shape_std = deviations(found, columns, solution)
    place = {number: len(found.bank.base) + i for i, number in enumerate(columns)}
    result = []
    for one in found.choices:
        variant = one.evidence.variant
        at = [place[number] for number in variant.columns]
        hypothesis = variant.hypothesis
        values = _unused(found, variant)
        for c, i in zip(variant.coefficients, at, strict=True):
            values[c.name] = Value(float(solution[i]), float(std[i]), c.unit)
        values, of_shape = apart(hypothesis, values, variant.shape, shape_std.get(id(one), {}))
        of_shape = reaching(found, one, of_shape, left)
        small = _small(found, one.evidence)
        result.append(
            Finding(
                hypothesis=hypothesis,
                joints=hypothesis.numbers,
                shape=variant.shape,
                parameters=values,
                evidence=one.evidence,
                alternatives=alternatives(hypothesis, one, found.variants, found.weighing.free),
                amplitude=_amplitude(found, variant, solution[at]),
                refined=_refined(found, variant, solution[at]),
                shape_std=of_shape,
                disagreement=disagreements.get(variant.key, ""),
                apart=one.apart,
                sure=not small,
                doubts=(*([] if firm else ["more than noise stays unexplained"]), *small),
            )
        )
    pulled = [number for one in result if pulls(one.hypothesis.effect) for number in one.joints]
    several = {number for number in pulled if pulled.count(number) > 1}
    free = found.weighing.free
    told = [doubted(one, _remains(found, one, left), several, found.repeats, free) for one in result]
    settled = [left_between(found, one.evidence, left) if one.hypothesis.effect == "backlash" else left for one in told]
    told = [doubted_drive_train(one, rest, _remains(found, one, rest)) for one, rest in zip(told, settled, strict=True)]
    told = beside_warming(beside_drive_trains(beside_any_torque(told)))
    return tuple(sorted(told, key=lambda one: -one.evidence.drop))


def _unused(found: Search, variant: Variant) -> dict[str, Value]:
    """Coefficients by name where none of them is in use: 0, of which nothing is known where the model takes them up."""
    whole = found.bank.add(variant.hypothesis, variant.shape) or variant
    hidden = {
        c.name
        for c, number in zip(whole.coefficients, whole.columns, strict=True)
        if found.weighing.normal.hides(number)
    }
    return {
        c.name: Value(0.0, math.inf if c.name in hidden and not c.refines else 0.0, c.unit)
        for c in variant.hypothesis.coefficients
    }


def _small(found: Search, one: Evidence) -> list[str]:
    """That it is not large enough to be firm, where nothing repeats."""
    if found.repeats:
        return []
    bank = found.bank
    taken = all(maps_taken(bank, found.maps, k) for k in one.variant.coordinates)
    least, why = (_APERIODIC, "no motion repeats") if taken else (_SHORT, "no motion repeats and rows are few")
    if one.size >= least:
        return []
    part = "" if least == 1 else f"{least:g} of "
    return [f"it is smaller than {part}the noise's rms: {why}, so noise is not told from what the model lacks"]


def _remains(found: Search, one: Finding, left: Mapping[int, float]) -> float:
    """What is ``left`` on the joint where a finding is largest, in parts of it."""
    return left.get(found.bank.robot.numbers[one.evidence.place], 0.0) / one.evidence.size


def _amplitude(found: Search, variant: Variant, values: Array) -> dict[int, float]:
    """The rms [N m, N] of what coefficients make on the fitted rows of each joint, by joint number."""
    moving = found.bank.robot.moving
    result = {}
    for j in variant.coordinates:
        power, rows = 0.0, 0
        for r in found.train:
            kept = found.bank.runs[r].kept[j]
            torque = values @ found.bank.columns(r, j, variant.columns)[:, kept]
            power, rows = power + float(torque @ torque), rows + torque.size
        result[moving[j].number] = float(np.sqrt(power / max(rows, 1)))
    return result


def _refined(found: Search, variant: Variant, values: Array) -> float:
    """How much coefficients that only refine make on the joint where they make most, in parts of what the rest does."""
    refines = np.array([one.refines for one in variant.coefficients])
    if not refines.any():
        return 0.0
    more, plain = (_amplitude(found, variant, np.where(which, values, 0.0)) for which in (refines, ~refines))
    most = max(more, key=lambda number: more[number])
    return more[most] / plain[most] if plain[most] else math.inf
