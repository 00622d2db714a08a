"""What is missing, said once: effect, joint, values with uncertainty, evidence, and what may stand in its place."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from generator.effects.library import library
from generator.review.decimals import scientific
from identification.diagnosis.columns.bank import Variant, columns_of
from identification.diagnosis.columns.hypothesis import (
    BODY,
    EFFECT,
    ELASTIC,
    SINCE_REVERSAL,
    Hypothesis,
    Key,
    on_joints,
)
from identification.diagnosis.noise.may_act import maps_taken
from identification.diagnosis.search.evidence import Evidence
from identification.diagnosis.search.likely import balances, pulls
from identification.diagnosis.search.loop import Search
from identification.diagnosis.search.selection import Choice
from identification.diagnosis.search.whole_orders import UNSURE
from identification.diagnosis.verdict.gap_crossings import left_between
from identification.diagnosis.verdict.shape_uncertainty import apart, deviations
from identification.outcome import Value

Array = NDArray[np.float64]

FIRM, TENTATIVE = "firm", "tentative"
#: Stand for whatever makes a ripple, a torque of the position, or friction that changes along the range, that is none
#: of the library's.
OTHER_RIPPLE, OTHER_TORQUE, OTHER_FRICTION = "other_ripple", "other_torque", "other_friction"
#: Standard deviation of a shape beyond which runs do not tell it, in parts of its value, or of its grid's step where
#: its zero means nothing.
_VAGUE = 0.5
#: What is left on a joint, in parts of what a finding explains there, from which it is not firm; of what pulls a link
#: to where it rests, and of friction over the position, which any torque of the position looks like.
_LEFT, _PULLED = 1.0, 0.15
#: Size of a finding, in parts of the noise's rms, below which it is not firm where nothing repeats: the noise is then
#: not known apart from the model. Where rows are too few to take what may act out of it as well.
_APERIODIC, _SHORT = 0.5, 1.0
#: Size, in parts of the noise's rms, below which a torque of the position is any; what is left on its joint, in those
#: parts too, and standard deviation of its values, in parts of them, from which it is.
_FAINT, _SHOWS, _LOOSE = 0.3, 0.4, 0.2
#: What is left of a swinging joint, in parts of the noise's rms and of what was explained, from which its law is not
#: sure; and the standard deviation of a gap, in parts of it, from which there may be none.
_SWUNG, _SWUNG_OF, _GAP = 1.0, 0.3, 0.25
#: Significant digits of a value without a standard deviation, and most of one with it.
_DIGITS, _MOST = 4, 6


@dataclass(frozen=True)
class Alternative:
    """Another effect that this data cannot tell from the one that was named; ``named`` says it in words."""

    effect: str
    title: str
    joints: tuple[int, ...]
    named: str
    score: float
    separating_experiment: str


@dataclass(frozen=True)
class Told:
    """A value of a finding [``unit``]; ``std`` is None for what was not searched and for a coefficient ``at_bound``,
    infinite for what the runs do not show. Of a ``scale`` any value will do.
    """

    name: str
    value: float
    std: float | None
    unit: str
    at_bound: bool = False
    scale: bool = False

    @property
    def digits(self) -> int:
        """Significant digits of the value, of which the standard deviation leaves the last two uncertain."""
        if not self.std or not self.value or not math.isfinite(self.std):
            return _DIGITS
        before = math.floor(math.log10(abs(self.value))) - math.floor(math.log10(self.std))
        return min(max(before + 2, 2), _MOST)

    def text(self, unit: str, plus_minus: str = "+-") -> str:
        """Value and standard deviation with the unit as it is written: ``0.053 +- 0.0014 rad/s``."""
        std = "" if self.std in (None, math.inf) else f" {plus_minus} {_written(self.std or 0.0, 2)}"
        return f"{_written(self.value, self.digits)}{std}{unit}{self._remark}"

    @property
    def _remark(self) -> str:
        if self.scale:
            return " (chosen: the runs tell the other lengths and the force only relative to it)"
        return " (at its bound)" if self.at_bound else " (not shown by these runs)" if self.std == math.inf else ""


def _written(x: float, digits: int) -> str:
    """Without a power of ten down to 1e-4, as small times are read."""
    return f"{x:.{digits}g}" if 1e-4 <= abs(x) < 1e-3 else scientific(x, digits)


@dataclass(frozen=True)
class Finding:
    """An effect on ``joints`` that the model lacks: ``parameters`` and ``shape`` values by name.

    ``amplitude`` is the rms of its torque on the fitted rows of each joint it acts on [N m, N], by joint number.
    ``shape_std`` are standard deviations of the shape values that were searched. ``disagreement`` tells in words how
    the runs disagree on its amplitude, if they do; ``apart`` whether no other shape of those that are tried alone does
    as well; ``sure`` that such a torque acts, whatever makes it.
    """

    hypothesis: Hypothesis
    status: str
    joints: tuple[int, ...]
    shape: Mapping[str, float]
    parameters: Mapping[str, Value]
    evidence: Evidence
    alternatives: tuple[Alternative, ...]
    amplitude: Mapping[int, float]
    shape_std: Mapping[str, float]
    disagreement: str = ""
    apart: bool = True
    sure: bool = True

    @property
    def known(self) -> dict[str, float]:
        """Coefficients [SI] by name, without those that the runs do not show."""
        return {name: one.value for name, one in self.parameters.items() if one.value is not None}

    @property
    def homogeneous(self) -> bool:
        """Whether one amplitude holds in all runs, and along each that repeats."""
        return not self.disagreement

    @property
    def variable(self) -> str:
        """What it shows over: of its coefficients that are not zero, where they agree."""
        whole = self.hypothesis.variable
        own = {one.variable or whole for one in self.hypothesis.coefficients if self.parameters[one.name].value}
        return own.pop() if len(own) == 1 else whole

    @property
    def told(self) -> tuple[Told, ...]:
        """Coefficients, then the shape."""
        units = {**self.hypothesis.units, **{shape.name: shape.unit for shape in self.hypothesis.shapes}}
        coefficients = [
            Told(c.name, one.value, one.std or None, one.unit, not one.value and not one.std)
            for c in self.hypothesis.coefficients
            if (one := self.parameters[c.name]).value is not None
            if one.std or not c.refines
        ]
        scales = {shape.name for shape in self.hypothesis.shapes if shape.scale}
        shape = [
            Told(name, value, self.shape_std.get(name), units.get(name, "1"), scale=name in scales)
            for name, value in self.shape.items()
        ]
        return (*coefficients, *shape)

    @property
    def main(self) -> tuple[Value, ...]:
        """Its coefficients but those that refine it, unless they are all that it has."""
        plain = tuple(self.parameters[c.name] for c in self.hypothesis.coefficients if not c.refines)
        refining = tuple(self.parameters[c.name] for c in self.hypothesis.coefficients if c.refines)
        return plain if any(one.value for one in plain) else refining or plain

    @property
    def determined(self) -> bool:
        """Whether the runs tell its values one by one, and not only the torque that they make together."""
        shapes = {one.name: one for one in self.hypothesis.shapes}
        sizes = {name: abs(self.shape[name]) if shapes[name].log else shapes[name].spacing for name in self.shape_std}
        told = all(std <= _VAGUE * sizes[name] for name, std in self.shape_std.items())
        return told and self.apart and not all(map(_vague, self.main))


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
        alternatives = _alternatives(hypothesis, one)
        values = _unused(found, variant)
        for c, i in zip(variant.coefficients, at, strict=True):
            values[c.name] = Value(float(solution[i]), float(std[i]), c.unit)
        values, of_shape = apart(hypothesis, values, variant.shape, shape_std.get(id(one), {}))
        large = one.evidence.size >= _least(found, variant)
        result.append(
            Finding(
                hypothesis=hypothesis,
                status=FIRM if firm and not alternatives and large else TENTATIVE,
                joints=hypothesis.numbers,
                shape=variant.shape,
                parameters=values,
                evidence=one.evidence,
                alternatives=alternatives,
                amplitude=_amplitude(found, one, solution[at]),
                shape_std=of_shape,
                disagreement=disagreements.get(variant.key, ""),
                apart=one.apart,
                sure=large,
            )
        )
    pulled = [number for one in result if pulls(one.hypothesis.effect) for number in one.joints]
    several = {number for number in pulled if pulled.count(number) > 1}
    told = [_doubted(one, _remains(found, one, left), several, found.repeats) for one in result]
    settled = [left_between(found, one.evidence, left) if one.hypothesis.effect == "backlash" else left for one in told]
    told = [_swinging(one, rest, _remains(found, one, rest)) for one, rest in zip(told, settled, strict=True)]
    told = _beside_any_torque(told)
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


def _least(found: Search, variant: Variant) -> float:
    """Size from which a finding is firm."""
    if found.repeats:
        return 0.0
    return _APERIODIC if all(maps_taken(found.bank, found.maps, k) for k in variant.joints) else _SHORT


def _remains(found: Search, one: Finding, left: Mapping[int, float]) -> float:
    """What is ``left`` on the joint where a finding is largest, in parts of it."""
    return left.get(found.bank.robot.numbers[one.evidence.place], 0.0) / one.evidence.size


def _beside_any_torque(told: Sequence[Finding]) -> list[Finding]:
    """With offsets as sure as the torques of the position beside them: another law there takes another offset."""
    doubted = {
        number for one in told if pulls(one.hypothesis.effect) and one.status == TENTATIVE for number in one.joints
    }
    return [
        replace(one, status=TENTATIVE)
        if one.hypothesis.effect == "offset" and not doubted.isdisjoint(one.joints)
        else one
        for one in told
    ]


def _doubted(one: Finding, remains: float, several: Collection[int], repeats: bool) -> Finding:
    """Tentative where its torque is known and its law is not: too much ``remains``, in parts of it, on the joint where
    it is largest, it is one of ``several`` springs on a joint, or the runs do not tell the values that make it a
    balancer or a payload and not any torque; the values of what slides before it slips, and where no motion
    ``repeats`` those of any effect.
    """
    effect, kind = one.hypothesis.effect, one.hypothesis.kind
    much = remains > min(_PULLED, _SHOWS / one.evidence.size)
    any_torque = pulls(effect) and (
        much or not set(one.joints).isdisjoint(several) or any(_vague(value, _LOOSE) for value in one.main)
    )
    any_torque |= balances(effect) and not one.determined
    any_torque |= pulls(effect) and one.evidence.size < _FAINT
    if any_torque:
        whole = "motion over the joint's whole range, with another payload"
        other = _unnamed(OTHER_TORQUE, "another torque of the position", one.joints, one.evidence, whole)
        return replace(one, status=TENTATIVE, alternatives=(*one.alternatives, other))
    if effect == "position_friction" and much:
        loads = "the same motion with another payload, which changes friction under load"
        other = _unnamed(OTHER_FRICTION, "other friction that changes along the range", one.joints, one.evidence, loads)
        return replace(one, status=TENTATIVE, alternatives=(*one.alternatives, other))
    if all(map(_unknown, one.main)):
        return replace(one, status=TENTATIVE, sure=False)
    if kind == EFFECT and not one.determined and (not repeats or one.variable == SINCE_REVERSAL):
        return replace(one, status=TENTATIVE)
    if remains > _LEFT or all(map(_vague, one.main)) or (kind == BODY and _vague(one.main[0])):
        return replace(one, status=TENTATIVE)
    return one


def _swinging(one: Finding, left: Mapping[int, float], remains: float) -> Finding:
    """Tentative where a drive train explains how a link swings and far more than noise is ``left`` all the same on a
    joint that its torque reaches, or much ``remains`` where it is largest, in parts of it; and where its gap is hardly
    more than none.
    """
    if one.hypothesis.kind != ELASTIC:
        return one
    (main, *_) = one.main
    if one.hypothesis.effect == "backlash" and (main.std or 0.0) > _GAP * abs(main.value or 0.0):
        title, experiment = "elasticity of the drive train without a gap", "motion in which the load changes its sign"
        other = _unnamed("joint_elasticity", title, one.joints, one.evidence, experiment)
        return replace(one, status=TENTATIVE, alternatives=(*one.alternatives, other))
    if remains > _SWUNG_OF or any(left.get(number, 0.0) > _SWUNG for number in one.amplitude):
        return replace(one, status=TENTATIVE)
    return one


def _unknown(one: Value) -> bool:
    return (one.std or 0.0) >= abs(one.value or 0.0)


def _vague(one: Value, part: float = _VAGUE) -> bool:
    return not one.value or (one.std or 0.0) > part * abs(one.value)


def _alternatives(mine: Hypothesis, one: Choice) -> tuple[Alternative, ...]:
    found = [_alternative(mine, other) for other in one.alternatives]
    if one.odds < UNSURE:
        title = "ripple whose order is no whole number"
        turns = "more turns of the joint in one run: they tell the order more closely"
        found.append(_unnamed(OTHER_RIPPLE, title, mine.numbers, one.evidence, turns))
    return tuple(found)


def _unnamed(effect: str, title: str, joints: tuple[int, ...], evidence: Evidence, experiment: str) -> Alternative:
    """Something of no law that explains as much."""
    return Alternative(effect, title, joints, f"{title} on {on_joints(joints)}", evidence.score, experiment)


def _alternative(mine: Hypothesis, other: Evidence) -> Alternative:
    one = other.variant.hypothesis
    return Alternative(one.effect, one.title, one.numbers, one.named, other.score, separating(mine, one))


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


def _amplitude(found: Search, one: Choice, values: Array) -> dict[int, float]:
    variant = one.evidence.variant
    moving = found.bank.robot.moving
    result = {}
    for j in variant.joints:
        power, rows = 0.0, 0
        for r in found.train:
            kept = found.bank.runs[r].kept[j]
            torque = values @ found.bank.columns(r, j, variant.columns)[:, kept]
            power, rows = power + float(torque @ torque), rows + torque.size
        result[moving[j].number] = float(np.sqrt(power / max(rows, 1)))
    return result
