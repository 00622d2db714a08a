"""The diagnosis of a robot's model by runs: where it fails, what is missing, how sure that is."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from generator.robot.description import Robot
from identification.diagnosis.finding import Finding, findings
from identification.diagnosis.hypothesis import Hypothesis
from identification.diagnosis.lack_of_fit import Lack, lack_of_fit
from identification.diagnosis.loop import Search, search
from identification.diagnosis.normal import Prior
from identification.diagnosis.prepared import Prepared
from identification.diagnosis.roles import Roles
from identification.diagnosis.views import View, strongest, views
from identification.observation import Regressors

Array = NDArray[np.float64]

FREE, KNOWN = "free_fit", "known_parameters"
NAMED, NOTHING, UNEXPLAINED = "effects_named", "no_discrepancy", "unexplained"

#: What may stay unexplained: in parts of the noise's rms, and of what was explained on the joint; chance.
_SMALL, _PART, _CHANCE = 0.2, 0.4, 1e-4
#: Where nothing repeats the noise is not known apart from the model, and more must stay.
_SMALL_APERIODIC = 0.5
#: Part of the residual's variance that a variable must order to be a signature.
_ORDERED = 0.05


@dataclass(frozen=True)
class Where:
    """Where model and measurement disagree most: ``joint`` (number, 0 if nowhere), ``variable``, its region in words.

    ``shares`` are the parts of that joint's residual that each variable orders. ``lack`` is each joint's.
    """

    joint: int
    variable: str
    region: str
    shares: Mapping[str, float]
    lack: tuple[Lack, ...]
    views: Mapping[int, tuple[View, ...]]


@dataclass(frozen=True)
class Diagnosis:
    """All that was found. ``before`` is the model as it stood, refitted; ``after`` the one with the findings.

    ``runs`` are all runs in the order of ``roles`` (train, validate, test); ``found`` holds the columns of those that
    are fitted or validate. ``residuals_before`` and ``residuals_after`` are torques [N m, N] (n x N rows) of the fitted
    and validating runs by the model of the search, all rows, as recorded.
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
) -> Diagnosis:
    """What the model of ``regressors`` lacks, from ``runs`` that fit and validate in the order of ``roles``.

    A ``dry`` one only says where model and measurement disagree, and names nothing.
    """
    train = range(len(roles.train))
    validate = range(len(roles.train), len(runs))
    found = search(runs, train, validate, regressors, prior, told, dry)
    told("looking where the residual is")
    before, after = (_where(found, weights) for weights in (found.start, found.weights))
    open_ = [lack for lack in after.lack if _large(lack, before)]
    verdict = UNEXPLAINED if open_ else NAMED if found.choices else NOTHING
    named = findings(found, firm=not open_)
    if named:
        before = _led(before, named[0])
    notes = [*roles.notes, *_notes(found, runs)]
    return Diagnosis(
        regressors.model.robot,
        FREE if prior is None else KNOWN,
        verdict,
        named,
        tuple(found.weighing.invisible()),
        before,
        after,
        roles,
        tuple(runs),
        found,
        tuple(_residuals(found, found.start)),
        tuple(_residuals(found, found.weights)),
        tuple(notes),
    )


def _large(lack: Lack, before: Where) -> bool:
    """Whether what a joint's model lacks is more than noise, and not small beside what was explained there."""
    if lack.burst is not None:
        return True
    least = _SMALL if lack.repeats else _SMALL_APERIODIC
    first = next(one.size for one in before.lack if one.joint == lack.joint)
    explained = float(np.sqrt(max(first**2 - lack.size**2, 0.0)))
    return lack.p < _CHANCE and lack.size > max(least, _PART * explained)


def _where(found: Search, weights: Mapping[int, float]) -> Where:
    bank = found.bank
    numbers = [joint.number for joint in bank.scenes[0].robot.moving]
    everything = range(len(bank.runs))
    lacks, seen = [], {}
    for k, number in enumerate(numbers):
        white = [bank.residual(r, k, weights) for r in everything]
        lacks.append(lack_of_fit(bank.runs, white, k, number, 1.0))
        raw = [bank.residual(r, k, weights, white=False) for r in everything]
        seen[number] = views(bank.runs, bank.scenes, raw, k, [one[k] for one in bank.colours])
    worst = max(lacks, key=lambda one: one.size)
    if worst.p > _CHANCE and worst.burst is None:
        return Where(0, "", "", {}, tuple(lacks), seen)
    variable, shares = strongest(seen[worst.joint])
    if worst.burst is not None and shares.get(variable, 0.0) < _ORDERED:
        run, t = worst.burst
        return Where(worst.joint, "time", f"once, at {t:.2f} s of {Path(run).name}", shares, tuple(lacks), seen)
    return Where(worst.joint, variable, _region(seen[worst.joint], variable), shares, tuple(lacks), seen)


def _region(found: Sequence[View], variable: str) -> str:
    """The bins that stand out of the noise's band, in words."""
    parts = []
    for one in found:
        if one.variable != variable:
            continue
        out = np.abs(one.mean) - one.band
        if not len(out) or out.max() <= 0:
            continue
        at = one.centre[out > 0.5 * out.max()]
        way = {-1: " moving backward", 0: "", 1: " moving forward"}[one.direction]
        span = f"{at.min():.3g} to {at.max():.3g}" if len(at) > 1 else f"about {at[0]:.3g}"
        parts.append(f"{variable} {span} {one.unit}{way}")
    return "; ".join(parts)


def _led(before: Where, first: Finding) -> Where:
    """With the joint and the variable of the leading finding, which has been told from all others."""
    joints = sorted(first.amplitude, key=lambda number: -first.amplitude[number])
    joint = first.hypothesis.joint or joints[0]
    shares = strongest(before.views[joint])[1]
    variable = first.hypothesis.variable or before.variable
    region = _region(before.views[joint], variable)
    return Where(joint, variable, region, shares, before.lack, before.views)


def _residuals(found: Search, weights: Mapping[int, float]) -> list[Array]:
    bank = found.bank
    return [
        np.stack([bank.residual(r, k, weights, white=False) for k in range(bank.dof)]) for r in range(len(bank.runs))
    ]


def _notes(found: Search, runs: Sequence[Prepared]) -> list[str]:
    notes = []
    if not all(run.period for run in runs):
        names = ", ".join(dict.fromkeys(run.sampled.run.file for run in runs if not run.period))
        notes.append(f"the motion of {names} does not repeat: noise is told from the model's faults less well")
    for one in found.choices:
        variant = one.evidence.variant
        others = [each.evidence.variant for each in found.choices if each is not one]
        if not found.weighing.homogeneous(variant, others):
            notes.append(f"{variant.hypothesis.named} differs between the runs: it drifts, or is chance")
    return notes
