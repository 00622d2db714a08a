"""A robot file with what was found in it, and the parameters of that model from the fitted runs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite

from generator.robot.description import ParameterSet, Robot
from generator.symbolic.model import Model
from identification import recipes
from identification.diagnosis.columns.hypothesis import BODY, EFFECT, LOAD, VALUE
from identification.diagnosis.columns.normal_equations import Prior
from identification.diagnosis.columns.payload_body import corrected
from identification.diagnosis.columns.priors import preferring, prior_of
from identification.diagnosis.diagnosis import Diagnosis
from identification.diagnosis.mending.addition import Addition, addition, measured
from identification.diagnosis.mending.beside_swings import (
    beside_swings,
    drive_trains,
    has_swings,
    swinging_alone,
)
from identification.diagnosis.mending.flexible_set import SET as FLEXIBLE
from identification.diagnosis.mending.flexible_set import flexible_set
from identification.diagnosis.mending.refit import Refit, refit, with_payload, with_values
from identification.diagnosis.mending.repair import Repaired, as_written, repaired
from identification.diagnosis.mending.writable import loaded, writable
from identification.diagnosis.noise.passing import without
from identification.diagnosis.runs.prepared import Prepared, prepared
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.finding import Finding
from identification.observation import Regressors
from identification.outcome import Value
from identification.robot_file import rounded
from identification.sampling import Sampled
from identification.sidecar import UNITS


@dataclass(frozen=True, kw_only=True)
class WrittenModel:
    """The ``findings`` that a ``repaired`` robot file holds, beside what was measured without torque; its parameters,
    and what is to be told of both.

    ``flexible`` is the set of the model with elastic drive trains, None where the file has none. What plays are
    ``regressors`` of a robot file with it, and values ``played`` [SI] of base parameters and of how links swing, if
    they do (``swings``), with ``loads`` [SI] beyond what sidecars state of a payload.
    """

    findings: tuple[Finding, ...]
    repaired: Repaired
    fit: Refit
    flexible: ParameterSet | None
    swings: bool
    regressors: Regressors
    played: Mapping[str, float]
    loads: Mapping[str, float]
    notes: tuple[str, ...]


def written_model(
    text: str, name: str, found: Diagnosis, findings: Sequence[Finding], prior: str | None
) -> WrittenModel:
    """The robot file ``text`` with those of ``findings`` that it can hold, its parameters near the set ``prior``."""
    aside, wanted = measured(found.search.offered), [*map(_addition, findings)]
    additions, unwritten = writable(text, name, [*wanted, *aside], found.roles, found.search.bank.scenes)
    new = repaired(text, name, additions)
    entered = [(finding, one) for finding, one in zip(findings, wanted, strict=True) if one in additions]
    held = tuple(finding for finding, _ in entered)
    regressors = Regressors(preferring(new.robot, prior))
    known = None if prior is None else _prior(prior, regressors, held)
    said, given = _description(held), _given(entered, new.robot)
    loads = {name: x for one in held if one.hypothesis.kind == LOAD for name, x in {**one.shape, **one.known}.items()}
    fit = refit(fitted_runs(found, regressors, loads), regressors, known, said, given)
    swings, bodies, played = has_swings(found.search, additions), fit.parameter_set, fit.written
    if swings:
        bodies = beside_swings(found.search, held, fit.regressors.model, bodies)
        played |= {name: rounded(one.value) for name, one in bodies.values.items()}
        played |= drive_trains(found.search, held)
    flexible = _flexible(bodies, fit.regressors.model, additions, swings)
    stated_aside = [one.evidence for one in aside if one in additions]
    return WrittenModel(
        findings=held,
        repaired=new,
        fit=fit,
        flexible=flexible,
        swings=swings,
        regressors=fit.regressors.described(_as_played(fit.regressors.model.robot, flexible, found.search, held)),
        played=played,
        loads=loads,
        notes=(*stated_aside, *unwritten, *new.notes, *_sidecars(found.search, loads), *fit.notes),
    )


def _flexible(bodies: ParameterSet, model: Model, additions: Sequence[Addition], swings: bool) -> ParameterSet | None:
    """The set of ``bodies`` and of the drive trains that were added, where there are any, or ``swings``; also where the
    file has one, of other parameters.
    """
    added = {key: x for one in additions for key, x in one.parameters.items()}
    if not (swings or added or FLEXIBLE in model.robot.parameter_sets):
        return None
    return flexible_set(model, bodies, added)


def _as_played(robot: Robot, flexible: ParameterSet | None, found: Search, findings: Sequence[Finding]) -> Robot:
    """The robot whose first set is the ``flexible`` one, if there is one, and of which those joints are elastic that
    swing.
    """
    sets = robot.parameter_sets
    if flexible is not None:
        sets = {FLEXIBLE: flexible, **{name: one for name, one in sets.items() if name != FLEXIBLE}}
    return swinging_alone(replace(robot, parameter_sets=sets), found, findings)


def prepared_runs(
    sources: Sequence[str], regressors: Regressors, loads: Mapping[str, float] | None = None
) -> Iterator[Prepared]:
    """Runs by the filters of the diagnosis: those of an identification blur what happens at low speed. Payloads that
    sidecars state have ``loads`` beyond that.
    """
    robot = regressors.model.robot
    for run in loaded(sources, robot):
        if run.payload is not None:
            run = replace(run, payload=corrected(run.payload, loads or {}))
        yield prepared(run, recipes.recipe_of(robot.name), regressors)


def fitted_runs(found: Diagnosis, regressors: Regressors, loads: Mapping[str, float] | None = None) -> list[Sampled]:
    """The runs that were searched, with all their rows but those of what passes by; ``loads`` as of prepared runs."""
    runs = prepared_runs(found.roles.searched, regressors, loads)
    return [without(one.sampled, found.search.passing) for one in runs]


def _sidecars(found: Search, loads: Mapping[str, float]) -> list[str]:
    """What the runs say of payloads that their sidecars state, where something is ``loads`` beyond that."""
    notes = []
    carried = [scene.sampled.run.payload for scene in found.bank.scenes]
    for stated in (one for one in carried if one is not None and loads):
        right = corrected(stated, loads).known
        other = [
            f"{stem} {right[stem]:.4g} {unit} for {stated.known[stem]:.4g}"
            for stem, unit in UNITS.items()
            if right[stem] != stated.known[stem]
        ]
        if other:
            notes.append(f"if it is the payload: by the runs {stated.name} has {', '.join(other)} of its sidecar")
    return list(dict.fromkeys(notes))


def _addition(one: Finding) -> Addition:
    return addition(one.hypothesis, one.told_shape, one.known, f"{one.hypothesis.title}, {one.status}", one.amplitude)


def _given(entered: Sequence[tuple[Finding, Addition]], robot: Robot) -> dict[str, Value]:
    """Parameters of effects as they were found, beside noise that has a colour: a fit without it finds other values of
    what is small, and none within its bounds. An effect that ``robot`` tells by another warmth has others.
    """
    return {
        name: value
        for finding, one in entered
        if one.kind == EFFECT and all(as_written(one, robot, robot.numbers.index(number)) for number in one.joints)
        for name, value in finding.parameters.items()
        if value.value is not None and isfinite(value.std)
    }


def _description(found: Sequence[Finding]) -> str:
    titles = ", ".join(dict.fromkeys(one.hypothesis.title for one in found))
    return f"base parameters with {titles}" if titles else "base parameters, nothing missing"


def _prior(name: str, regressors: Regressors, found: Sequence[Finding]) -> Prior:
    """What the set says of the new model's base parameters, with a payload and other values that were found."""
    prior = prior_of(regressors.model, name)
    for one in found:
        if one.hypothesis.kind == BODY:
            std = {name: one.parameters[name].std for name in one.known}
            prior = with_payload(prior, regressors, one.known, std)
        elif one.hypothesis.kind == VALUE:
            prior = with_values(prior, regressors, one.parameters)
    return prior
