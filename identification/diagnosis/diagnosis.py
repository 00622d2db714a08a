"""The diagnosis of a robot's model by runs: where it fails, what is missing, how sure that is."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from generator.robot.description import Robot
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.columns.normal_equations import Prior
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.roles import Roles
from identification.diagnosis.search.invisible import invisible
from identification.diagnosis.search.loop import Search, search
from identification.diagnosis.search.scaling import taken_up
from identification.diagnosis.verdict import few_rows, odd_run, remarks, trembling
from identification.diagnosis.verdict.confirmation import confirmed
from identification.diagnosis.verdict.contradiction import Contradicted, contradicted, doubted, note
from identification.diagnosis.verdict.finding import Finding
from identification.diagnosis.verdict.homogeneity import disagreements
from identification.diagnosis.verdict.lack_of_fit import CHANCE
from identification.diagnosis.verdict.named import findings
from identification.diagnosis.verdict.patchwork import PATCHED, patched
from identification.diagnosis.verdict.trial import along
from identification.diagnosis.verdict.unexplained import NOT_JUDGED, Unexplained, unexplained
from identification.diagnosis.verdict.waterfall import Steps, steps
from identification.diagnosis.verdict.where import Where, led, located, seen
from identification.observation import Regressors

FREE, KNOWN = "free_fit", "known_parameters"
NAMED, NOTHING, UNEXPLAINED = "effects_named", "no_discrepancy", "unexplained"
#: The verdict where nothing was looked for by name.
LOCATED = "located"


@dataclass(frozen=True, kw_only=True)
class Diagnosis:
    """All that was found. ``before`` is the model as it stood, refitted; ``after`` the one with the findings, and where
    more than noise stays unexplained: nowhere, unless that is the verdict.

    ``contradicted`` are known parameters of which the runs say that they have other values. ``reason`` is that of
    ``Unexplained``, or PATCHED. ``runs`` are all runs in the order of ``roles`` (train, validate); ``search`` holds the
    columns of those that are fitted or validate; ``steps`` is how near to the noise each finding comes.
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
    search: Search
    steps: Steps
    contradicted: tuple[Contradicted, ...]
    reason: str
    notes: tuple[str, ...]

    @cached_property
    def residuals_before(self) -> tuple[Array, ...]:
        """What the model as it stood leaves of the torques of each run that is fitted or validates, as recorded, all
        rows (n x N) [N m, N].
        """
        return _residuals(self.search, self.search.start)

    @cached_property
    def residuals_after(self) -> tuple[Array, ...]:
        """The same of the model with the findings."""
        return _residuals(self.search, self.search.weights)


def diagnose(
    regressors: Regressors,
    runs: Sequence[Prepared],
    roles: Roles,
    prior: Prior | None = None,
    progress: Callable[[str], None] = lambda _: None,
    dry: bool = False,
    test: Sequence[Prepared] = (),
) -> Diagnosis:
    """What the model of ``regressors`` lacks, from ``runs`` that fit and validate in the order of ``roles``.

    What the runs ``test`` contradict is taken back; nothing else is decided by them. A ``dry`` diagnosis only says
    where model and measurement disagree, and names nothing.
    """
    train = range(len(roles.train))
    validate = range(len(roles.train), len(runs))
    found = search(runs, train, validate, regressors, prior, progress, dry)
    robot, few = regressors.model.robot, found.weighing.few
    trial = None if dry else along(found, test)
    found, gone = confirmed(found, trial)
    small = [] if dry else few_rows.left_out(found)
    progress("looking where the residual is")
    first, last = seen(found, found.start), seen(found, found.weights)
    before = located(first, [lack for lack in first.lack if lack.p < CHANCE or lack.burst is not None])
    disagreeing = disagreements(found)
    other = () if dry else contradicted(found, prior)
    left = NOT_JUDGED if dry else unexplained(found, gone, trial, last, disagreeing, other)
    verdict = LOCATED if dry else UNEXPLAINED if left.missing else NAMED if found.choices else NOTHING
    beyond = {one.joint: one.size for one in last.lack if one.told}
    alone = findings(found, not left.lacks, disagreeing, beyond)
    named = doubted(found, few_rows.doubted(few, robot, alone, small), other)
    rest, reason = left.where or last, left.reason
    if verdict == NAMED and (number := patched(named)):
        verdict, reason = UNEXPLAINED, PATCHED
        rest = located(last, [one for one in last.lack if one.joint == number])
    notes = [
        *roles.notes,
        *few_rows.notes(few, robot, small),
        *remarks.of_tests(found, trial, test),
        *note(other),
        *remarks.of_elasticity(found),
        *remarks.of_motion(runs, bool(named) and not found.repeats),
        *(() if dry else remarks.of_warmth(found)),
        *remarks.of_warm_starts(found),
        *remarks.of_findings(named, gone),
        *_of_rest(found, last, left, bool(named)),
    ]
    return Diagnosis(
        robot=robot,
        mode=FREE if prior is None else KNOWN,
        verdict=verdict,
        findings=named,
        invisible=_invisible(found),
        before=_where(before, named, rest, last),
        after=rest,
        roles=roles,
        runs=tuple(runs),
        search=found,
        steps=steps(found, trial),
        contradicted=other,
        reason=reason,
        notes=tuple(notes),
    )


def _residuals(found: Search, values: Mapping[int, float]) -> tuple[Array, ...]:
    """What columns with ``values`` by number leave of each run's torques (n x N) [N m, N]."""
    return tuple(found.bank.residuals(r, values) for r in range(len(found.bank.runs)))


def _where(before: Where, named: Sequence[Finding], rest: Where, last: Where) -> Where:
    """Where the model as it stood fails: at what was found first, else where something stays unexplained."""
    if named:
        return led(before, named[0], last)
    if rest.joint:
        return replace(before, joint=rest.joint, variable=rest.variable, region=rest.region, shares=rest.shares)
    return before


def _of_rest(found: Search, last: Where, left: Unexplained, named: bool) -> Iterator[str]:
    """In words, what else is to be told of joints on which more than noise stays."""
    lacks = {one.joint: one.size for one in left.lacks}
    lacking = set(lacks)
    yield from left.notes
    yield from remarks.of_lacks(last.lack, left, named)
    if lacking:
        yield from odd_run.notes(found, lacking)
    yield from remarks.of_swings(found, lacking)
    yield from remarks.of_links(found, lacking)
    yield from trembling.notes(found, lacks)


def _invisible(found: Search) -> tuple[Hypothesis, ...]:
    """What these runs cannot show, without what was found all the same."""
    chosen = {one.evidence.variant.key for one in found.choices}
    taken = {one.key: one for one in (*invisible(found.weighing), *taken_up(found.weighing))}
    return tuple(one for key, one in taken.items() if key not in chosen)
