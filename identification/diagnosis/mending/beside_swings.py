"""Elastic drive trains beside the rigid model: the base parameters that they leave, of which a fit of the rigid model
makes other ones, and how far each of them swings.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence, Set
from dataclasses import replace

import numpy as np

from generator.effects.joint_elasticity import EFFECT as ELASTICITY
from generator.effects.rotor_inertia import EFFECT as ROTOR
from generator.robot.description import ParameterSet, Robot
from generator.symbolic.model import Model
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import EFFECT, ELASTIC
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.runs.stated_elasticity import BOUNCING, TOGETHER, damped, names
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.finding import Finding
from identification.diagnosis.verdict.stated_swings import swing

#: Kinds of what changes no base parameter that the searched model has as well, and such corrections of signals.
_APART, _LATE = (EFFECT, ELASTIC), ("torque_delay", "link_delay")


def has_swings(found: Search, additions: Collection[Addition]) -> bool:
    """Whether a model with ``additions`` plays with swings: of drive trains of the file, or of those that were found,
    unless what else was added changes the base parameters, which the search then does not tell.
    """
    elastic = any(one.kind == ELASTIC for one in additions)
    return (elastic or swing(found)) and all(one.kind in _APART or one.effect in _LATE for one in additions)


def beside_swings(found: Search, findings: Sequence[Finding], model: Model, rigid: ParameterSet) -> ParameterSet:
    """The set ``rigid`` of ``model`` with those base parameters in it that the searched model has alike, as all runs
    tell them beside the ``findings``.
    """
    solution, covariance = found.weighing.fitted(_variants(found, findings), True)
    values, bank = found.bank.values(solution), found.bank
    std = dict(zip(bank.base, np.sqrt(np.maximum(covariance.diagonal(), 0.0)).tolist(), strict=False))
    searched, own = (_grouped(each, _brought(findings)) for each in (bank.scenes[0].regressors.model, model))
    same = {own[terms]: name for terms, name in searched.items() if terms in own}
    told = {
        name: replace(one, value=values[same[name]], relative_std=100 * std[same[name]] / abs(values[same[name]]))
        for name, one in rigid.values.items()
        if values.get(same.get(name, ""))
    }
    return replace(rigid, values={**rigid.values, **told})


def _brought(findings: Sequence[Finding]) -> set[str]:
    """Rotors' inertias by name that elastic drive trains bring as a part of what links had, and none by itself."""
    elastic = {number for one in findings if one.hypothesis.kind == ELASTIC for number in one.joints}
    by_itself = {one.joints for one in findings if one.hypothesis.effect == ROTOR.id}
    return {f"Ia{number}" for number in elastic if (number,) not in by_itself}


def _grouped(model: Model, rotors: Set[str]) -> dict[frozenset[tuple[str, float]], str]:
    """The base parameters by what they are made of but ``rotors`` that are grouped with bodies."""
    result = {}
    for name, terms in model.grouping.numeric().items():
        bodies = {part: factor for part, factor in terms.items() if part not in rotors}
        result[frozenset((bodies or terms).items())] = name
    return result


def without_findings(found: Search) -> dict[str, float]:
    """Base parameters of the searched model [SI], and what the file's elastic drive trains have, as all runs tell them
    without anything that was found; nothing where none of these swings.
    """
    return found.bank.values(found.weighing.fitted((), True)[0]) if swing(found) else {}


def drive_trains(found: Search, findings: Sequence[Finding]) -> dict[str, float]:
    """What the elastic drive trains of the file, where they swing, and of ``findings`` have, by the names of
    ``stated_elasticity``.
    """
    result: dict[str, float] = {}
    if swing(found):
        fitted = found.bank.values(found.weighing.fitted(_variants(found, findings), True)[0])
        result = {name: fitted[name] for name in names(found.bank.robot)}
    for one in findings:
        if one.hypothesis.kind == ELASTIC:
            (number,) = one.joints
            # What the file said of its stiffness, the values were about.
            result = {name: x for name, x in result.items() if name == TOGETHER or not _is_of(name, number)}
            result |= damped(number, one.shape["damping"])
            result.setdefault(f"{BOUNCING}{number}" if one.hypothesis.effect == "backlash" else TOGETHER, 1.0)
    return result


def swinging_joints(found: Search, findings: Sequence[Finding], flexible: Sequence[int]) -> tuple[int, ...]:
    """Of the ``flexible`` joints, by number, those of ``findings``, and the file's where they swing."""
    own = {number for one in findings if one.hypothesis.kind == ELASTIC for number in one.joints}
    return tuple(number for number in flexible if number in own or swing(found))


def swinging_alone(robot: Robot, found: Search, findings: Sequence[Finding]) -> Robot:
    """The ``robot`` of which the ``swinging_joints`` alone are elastic: without the gaps of the others."""
    elastic = swinging_joints(found, findings, robot.flexible)
    rigid = set(robot.flexible).difference(elastic)
    uses = [
        replace(use, joints=tuple(j for j in use.joints if j not in rigid)) if use.effect == ELASTICITY.id else use
        for use in robot.effects
    ]
    return replace(robot, flexible=elastic, effects=tuple(use for use in uses if use.joints))


def _variants(found: Search, findings: Sequence[Finding]) -> list[Variant]:
    keys = {one.hypothesis.key for one in findings}
    return [one for one in found.variants if one.key in keys]


def _is_of(name: str, number: int) -> bool:
    return name.removeprefix(name.rstrip("0123456789")) == str(number)
