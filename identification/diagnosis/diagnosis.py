"""The diagnosis of a robot's model by runs: where it fails, what is missing, how sure that is."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from generator.review.words import listed
from generator.robot.description import Robot
from identification.diagnosis import few_rows, odd_run
from identification.diagnosis.confirmation import confirmed
from identification.diagnosis.contradiction import Contradicted, contradicted, note, pulled
from identification.diagnosis.evidence import Key, key_of
from identification.diagnosis.finding import Finding, findings
from identification.diagnosis.homogeneity import disagreements
from identification.diagnosis.hypothesis import Hypothesis, on_joints
from identification.diagnosis.lack_of_fit import CHANCE, Lack
from identification.diagnosis.loop import Search, search
from identification.diagnosis.normal import Prior
from identification.diagnosis.overlooked import untested, untold
from identification.diagnosis.prepared import Prepared
from identification.diagnosis.roles import Roles
from identification.diagnosis.scaling import taken_up
from identification.diagnosis.selection import Choice
from identification.diagnosis.stated_elasticity import TOGETHER, names_of_backlash, stated
from identification.diagnosis.steps import Steps, steps
from identification.diagnosis.trial import Trial, along, comparable
from identification.diagnosis.where import Where, led, located, seen
from identification.observation import Regressors

Array = NDArray[np.float64]

FREE, KNOWN = "free_fit", "known_parameters"
NAMED, NOTHING, UNEXPLAINED = "effects_named", "no_discrepancy", "unexplained"
#: The verdict where nothing was looked for by name.
LOCATED = "located"

#: Why something stays unexplained where a residual does not say so.
VALUES, AMPLITUDES = "values", "amplitudes"

#: What may stay unexplained, in parts of what was explained on the joint.
_PART = 0.3
#: Part of the torque of the file's elastic drive trains below which they are none, by so many standard deviations.
_ELASTIC, _SURE = 0.5, 4.0


@dataclass(frozen=True)
class Diagnosis:
    """All that was found. ``before`` is the model as it stood, refitted; ``after`` the one with the findings, and where
    more than noise stays unexplained: nowhere, unless that is the verdict.

    ``contradicted`` are known parameters of which the runs say that they have other values. ``reason`` is what alone
    says that something stays unexplained: other ``VALUES`` than are known, or ``AMPLITUDES`` that do not hold; else
    empty.
    ``runs`` are all runs in the order of ``roles`` (train, validate, test); ``found`` holds the columns of those that
    are fitted or validate; ``steps`` is how near to the noise each finding comes. ``residuals_before`` and
    ``residuals_after`` are torques [N m, N] (n x N rows) of the fitted and validating runs by the model of the search,
    all rows, as recorded.
    """

    robot: Robot
    mode: str
    verdict: str
    findings: tuple[Finding, ...]
    invisible: tuple[Hypothesis, ...]
    before: Where
    after: Where
    roles: Roles
    runs: tuple[Prepared, ...]
    found: Search
    steps: Steps
    contradicted: tuple[Contradicted, ...]
    reason: str
    residuals_before: tuple[Array, ...]
    residuals_after: tuple[Array, ...]
    notes: tuple[str, ...]


def diagnose(
    regressors: Regressors,
    runs: Sequence[Prepared],
    roles: Roles,
    prior: Prior | None = None,
    told: Callable[[str], None] = lambda _: None,
    dry: bool = False,
    test: Sequence[Prepared] = (),
) -> Diagnosis:
    """What the model of ``regressors`` lacks, from ``runs`` that fit and validate in the order of ``roles``.

    What the runs ``test`` contradict is taken back; nothing else is decided by them. A ``dry`` diagnosis only says
    where model and measurement disagree, and names nothing.
    """
    train = range(len(roles.train))
    validate = range(len(roles.train), len(runs))
    found = few_rows.without_small(search(runs, train, validate, regressors, prior, told, dry))
    trial = None if dry else along(found, test)
    found, gone = confirmed(found, trial)
    told("looking where the residual is")
    start, weights = found.start, found.weights
    first, last = seen(found, start), seen(found, weights)
    before = located(first, [lack for lack in first.lack if lack.p < CHANCE or lack.burst is not None])
    bounces = _bounces(found, weights)
    explained = _explained(found, start, weights)
    open_ = [] if dry else [one for one in last.lack if _large(one, explained[one.joint], bounces.get(one.joint, 0.0))]
    disagreeing = disagreements(found)
    doubtful = [] if dry or open_ else _doubtful(found, last, disagreeing)
    open_ = open_ or doubtful
    overlooked = {} if dry or open_ or found.choices else _overlooked(found, trial)
    open_ = open_ or [last.lack[k] for k in overlooked]
    after = _over_time(located(last, open_), overlooked)
    other = () if dry else contradicted(found, prior)
    pulling = None if open_ or found.choices else pulled(found, other)
    if pulling is not None:
        after = replace(after, joint=last.lack[pulling].joint, region="by other values than are known")
    missing = bool(open_) or pulling is not None
    verdict = LOCATED if dry else UNEXPLAINED if missing else NAMED if found.choices else NOTHING
    beyond = {one.joint: one.size for one in last.lack if one.told}
    named = findings(found, not open_, disagreeing, beyond)
    if named:
        before = led(before, named[0])
    notes = [
        *roles.notes,
        *few_rows.notes(found.bank),
        *_unmoved(found, test),
        *_untried(found, trial, test),
        *note(other),
        *_of_elasticity(found),
        *_notes(named, runs, not found.repeats),
        *_taken_back(gone),
        *overlooked.values(),
    ]
    if open_:
        notes += dict.fromkeys(
            f"what is left on joint {one.joint} follows {one.follows}" for one in open_ if one.follows
        )
        notes += odd_run.notes(found)
    if not open_:
        notes += _hardly(last.lack)
    if named and not open_:
        notes += _little([lack for lack in last.lack if lack.joint not in bounces])
    return Diagnosis(
        regressors.model.robot,
        FREE if prior is None else KNOWN,
        verdict,
        named,
        _invisible(found),
        before,
        after,
        roles,
        tuple(runs),
        found,
        steps(found, trial),
        other,
        VALUES if pulling is not None else AMPLITUDES if doubtful else "",
        tuple(_residuals(found, start)),
        tuple(_residuals(found, weights)),
        tuple(notes),
    )


def _unmoved(found: Search, test: Sequence[Prepared]) -> list[str]:
    """What is to be told of joints that move where nothing is fitted."""
    moving = found.bank.scenes[0].robot.moving
    unseen = [k for k in range(len(moving)) if k not in found.bank.shown and any(run.kept[k].any() for run in test)]
    where = on_joints(moving[k].number for k in unseen)
    return [f"no run that is fitted tells of {where}, on which those that test have rows"] if unseen else []


def _untried(found: Search, trial: Trial | None, test: Sequence[Prepared]) -> list[str]:
    """What is to be told of runs that test and hold nothing to account."""
    unlike = [run.sampled.run for run in test if not comparable(run, found)]
    notes = [
        f"{one.file} is logged at {one.rate:.4g} Hz, the fitted runs are not: their noise is not its own, and nothing "
        "is held against it"
        for one in unlike
    ]
    if test and trial is None and len(unlike) < len(test):
        notes.append("the runs that test cannot show what was found: nothing is held against them")
    return notes


def _invisible(found: Search) -> tuple[Hypothesis, ...]:
    """What these runs cannot show, without what was found all the same."""
    chosen = {key_of(one.evidence.variant) for one in found.choices}
    taken = {(one.effect, one.joint): one for one in (*found.weighing.invisible(), *taken_up(found.weighing))}
    return tuple(one for key, one in taken.items() if key not in chosen)


def _bounces(found: Search, values: Mapping[int, float]) -> dict[int, float]:
    """By the joint's number, the rms of the file's backlash beside the noise's, of which no file tells all: how a link
    bounces the smallest error changes.
    """
    bank, result = found.bank, {}
    for one in stated(bank.scenes[0].robot):
        if one.gap:
            numbers = [bank.base.index(name) for name in names_of_backlash(one.number)]
            weights = {number: values[number] for number in numbers}
            both = [[bank.residual(r, one.k, some) for some in ({}, weights)] for r in range(len(bank.runs))]
            result[one.number] = float(np.sqrt(np.mean(np.concatenate([a - b for a, b in both]) ** 2)))
    return result


def _explained(found: Search, start: Mapping[int, float], weights: Mapping[int, float]) -> dict[int, float]:
    """By the joint's number, the rms beside the noise's of what was found there."""
    bank, result = found.bank, {}
    for k, joint in enumerate(bank.scenes[0].robot.moving):
        first, last = (
            np.concatenate([bank.residual(r, k, values) for r in range(len(bank.runs))]) for values in (start, weights)
        )
        result[joint.number] = float(np.sqrt(max(float(first @ first - last @ last), 0.0) / max(len(first), 1)))
    return result


def _large(lack: Lack, explained: float, bounces: float) -> bool:
    """Whether what a joint's model lacks is more than noise, and not small beside what was ``explained`` there, or
    beside what the file explains by a link that ``bounces``.
    """
    return lack.burst is not None or (lack.told and lack.size > _PART * float(np.hypot(explained, bounces)))


def _hardly(lacks: Sequence[Lack]) -> list[str]:
    """What is told of joints of ``lacks`` that keep more than chance, though not more than noise that is not known may
    be.
    """
    where = [f"{one.size:.2g} times the noise on joint {one.joint}" for one in lacks if one.hardly]
    if not where:
        return []
    return [f"more than chance is left, {listed(where)}: so little is not told from noise where no motion repeats"]


def _little(lacks: Sequence[Lack]) -> list[str]:
    """What is told of joints of ``lacks`` that keep more than noise, though little beside what was explained there."""
    sizes = [f"{one.size:.2g} times the noise on joint {one.joint}" for one in lacks if one.told]
    if not sizes:
        return []
    return [
        f"more than noise is left, little beside what was explained there: {listed(sizes)}; a diagnosis of the new "
        "robot file may show what it is"
    ]


def _doubtful(found: Search, last: Where, disagreeing: Collection[Key]) -> list[Lack]:
    """Of the joints on which findings act of whose amplitude the runs disagree."""
    return [last.lack[k] for one in found.variants if key_of(one) in disagreeing for k in one.joints]


def _overlooked(found: Search, trial: Trial | None) -> dict[int, str]:
    """By coordinate, the worst first, why something is missing though nothing was found, in words."""
    numbers = [joint.number for joint in found.bank.scenes[0].robot.moving]
    most = untold(found, found.start)
    tested = {} if trial is None else untested(found, trial)
    said = {
        k: f"most of how the torque of joint {numbers[k]} varies follows from nothing, too slowly for noise"
        for k in sorted(most, key=lambda k: -most[k])
    }
    said |= {
        k: f"the runs that test keep {tested[k]:.2g} times the noise on joint {numbers[k]}, the others do not: what is "
        "missing there changes from run to run, or with time"
        for k in sorted(tested, key=lambda k: -tested[k])
        if k not in most
    }
    return said


def _over_time(after: Where, overlooked: Mapping[int, str]) -> Where:
    """Where the runs say what was ``overlooked`` they do not say over which variable."""
    if not overlooked:
        return after
    first = after.lack[next(iter(overlooked))].joint
    return replace(after, joint=first, variable="time", region="changes with time or from run to run", shares={})


def _residuals(found: Search, weights: Mapping[int, float]) -> list[Array]:
    bank = found.bank
    return [
        np.stack([bank.residual(r, k, weights, white=False) for k in range(bank.dof)]) for r in range(len(bank.runs))
    ]


def _of_elasticity(found: Search) -> list[str]:
    """What is to be told of drive trains that the file says are elastic."""
    trains = stated(found.bank.scenes[0].robot)
    if not trains:
        return []
    where = on_joints(one.number for one in trains)
    notes = [
        f"the drive trains of {where} are elastic in the robot's file: what that adds to the torques is taken from its "
        "stiffnesses; the rigid inverse dynamics, which plays the untouched runs, does not know it"
    ]
    if TOGETHER in found.values:
        at = found.bank.base.index(TOGETHER)
        part, std = found.values[TOGETHER], float(np.sqrt(found.covariance[at, at]))
        if part + _SURE * std < _ELASTIC:
            shown = 100 * max(part, 0.0)
            notes.append(f"the runs show {shown:.0f} % of that torque: these drive trains are stiffer than stated")
    return notes


def _taken_back(gone: Sequence[Choice]) -> list[str]:
    why = "is taken back: the runs that test contradict it, or what it stood beside"
    return [f"{one.evidence.variant.hypothesis.named} {why}" for one in gone]


def _notes(found: Sequence[Finding], runs: Sequence[Prepared], aperiodic: bool) -> list[str]:
    small = ", and what is small beside it is not firm" if found and aperiodic else ""
    unlike: dict[str, list[str]] = {}
    for run in runs:
        if run.unlike:
            unlike.setdefault(run.unlike, []).append(run.sampled.run.file)
    notes = [
        f"the motion of {listed(dict.fromkeys(names))} {why}: noise is told from the model's faults less well{small}"
        for why, names in unlike.items()
    ]
    for one in found:
        if one.disagreement:
            notes.append(f"{one.hypothesis.named} {one.disagreement}: it drifts, or something else makes it")
    return notes
