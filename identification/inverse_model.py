"""Identification with the inverse dynamic model and least squares, IDIM-LS (report section 3.1), as one call."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from generator.errors import InputError
from generator.robot.description import Robot
from generator.words import listed
from identification import recipes
from identification.agreement import agreement, of_one_sign
from identification.bootstrap import bootstrapped
from identification.dataset import Run, load
from identification.essential import GROWTH, RATIO, essential
from identification.factors import Factor, added
from identification.least_squares import Problem, Solution, not_shown
from identification.observation import Regressors
from identification.observed import Observed
from identification.own_load import under_own_load
from identification.recipes import Recipe
from identification.residuals import Residuals, residuals
from identification.robust import robust
from identification.run_filters import filters_of, notes_of
from identification.sampling import SPOILED, Rows, Sampled, sampled
from identification.set_values import shown_together
from identification.shared_samples import fitted_too, unshared
from identification.sidecar import Payload, by_name, check_carried
from identification.signs import directed, opposed
from identification.suspicion import beyond, of_one_sense, ordered, suspect

#: Residual of the essential parameters, in parts of that of all, from which it is told.
_COSTLY = 2.0


@dataclass(frozen=True)
class Options:
    """What is asked for.

    ``recipe`` is the robot's own where None. ``fixed`` are values [SI] of parameters that are not estimated; ``ratio``
    is r_sigma of the essential parameters, whose residual may be larger by the part ``growth`` (infinite: by any);
    ``payload`` is that of runs whose sidecar tells none, and contradicts no other. So many ``draws`` of a block
    bootstrap give the standard deviations of the full model; 0 means those of independent residuals.
    """

    recipe: Recipe | None = None
    fixed: Mapping[str, float] = field(default_factory=dict)
    ratio: float = RATIO
    growth: float = GROWTH
    robust: bool = False
    payload: Payload | None = None
    draws: int = 0


@dataclass(frozen=True)
class Estimate:
    """A model's parameters with what they leave of the torques, on the runs used and on those held out (None if none).

    ``sought`` are the parameters that were estimated; others are fixed or, in an essential model, zero.
    """

    solution: Solution
    sought: tuple[str, ...]
    train: Residuals
    test: Residuals | None


@dataclass(frozen=True)
class Identification:
    """All that was found: the model with all parameters and the essential one; every repair and doubt in ``notes``."""

    regressors: Regressors
    options: Options
    recipe: Recipe
    train: tuple[Observed, ...]
    test: tuple[Observed, ...]
    problem: Problem
    full: Estimate
    essential: Estimate
    notes: tuple[str, ...]

    @property
    def robot(self) -> Robot:
        """The robot as its file says."""
        return self.regressors.model.robot

    @property
    def units(self) -> dict[str, str]:
        """Those of the base parameters by name."""
        return {parameter.name: parameter.unit for parameter in self.regressors.model.base_parameters}

    @property
    def essential_names(self) -> tuple[str, ...]:
        """Parameters that the essential model keeps and the data show by themselves, not in sums alone."""
        return tuple(name for name in self.essential.sought if name not in self.full.solution.hidden)

    def noting(self, more: Iterable[str]) -> Identification:
        """The same with ``more`` to be told."""
        return replace(self, notes=(*self.notes, *more))


def identify(
    robot: Robot,
    data: Sequence[str | Path],
    test: Sequence[str | Path] = (),
    options: Options | None = None,
    regressors: Regressors | None = None,
) -> Identification:
    """Parameters of ``robot`` from the runs ``data``, tried on the runs ``test``.

    A run is a path, or ``PATH@FROM:TO`` with times in s. ``regressors`` may be given to use them again.

    Raises InputError for runs that cannot be used, for fixed parameters that the robot does not have, and for a payload
    that no run carries.
    """
    options = options or Options()
    recipe = options.recipe or recipes.recipe_of(robot.name)
    given = regressors or Regressors(robot)
    trained, tried = (
        tuple(_observed(_loaded(str(source), robot, recipe, options), recipe, given) for source in sources)
        for sources in (data, test)
    )
    fitted, tested = ([one.sampled.run for one in runs] for runs in (trained, tried))
    unshared({"fit": fitted})
    check_carried(options.payload, [run.payload for run in (*fitted, *tested)])
    payloads = _known_payloads(trained, tried)
    notes = [note for one in (*trained, *tried) for note in _notes_on(one, robot, recipe)]
    notes += fitted_too(fitted, tested)

    def posed(factors: tuple[Factor, ...]) -> Problem:
        return _problem(factors, given.names, payloads, recipe, options)

    sampled_runs, place = [one.sampled for one in trained], fitted[0].place
    regressors, told = under_own_load(sampled_runs, given, lambda factors: posed(factors).solve())
    notes += told
    if regressors is not given:
        trained, tried = (tuple(Observed(one.sampled, regressors) for one in runs) for runs in (trained, tried))
    factors, tests = _added(trained), _added(tried)
    _check_rows(factors, sampled_runs)
    problem, told = _separable(posed(factors), _payloads(trained))
    notes += told
    notes += agreement(trained, problem, regressors.model)
    plain = problem
    problem, solution, told = _solved(problem, trained, options)
    notes += told
    full = _estimate(problem, solution, factors, tests)
    notes += suspect(sampled_runs, regressors, full.train)
    std = {name: solution.std(name) for name in full.sought if name not in solution.hidden}
    directed(place, regressors.model, solution.values, std)
    of_one_sense(sampled_runs, regressors, full.train)
    if full.test is not None:
        ordered([one.sampled for one in tried], regressors, full.test)
    for one in tried:
        opposed(one.sampled.run.place, one.factors, solution.values)
        of_one_sign(one, plain, regressors.model)
    best = _estimate(*essential(problem, options.ratio, options.growth), factors, tests)
    notes += _doubts(regressors, full, best)
    return Identification(regressors, options, recipe, trained, tried, problem, full, best, tuple(notes))


def _loaded(source: str, robot: Robot, recipe: Recipe, options: Options) -> Run:
    return load(source, robot, recipe.columns).carrying(options.payload)


def _observed(run: Run, recipe: Recipe, regressors: Regressors) -> Observed:
    filters_of(run, recipe)
    return Observed(sampled(run, recipe, regressors), regressors)


def _added(runs: Iterable[Observed]) -> tuple[Factor, ...]:
    return added([one for run in runs for one in run.factors])


def _payloads(runs: Iterable[Observed]) -> dict[str, Payload]:
    return by_name((one.sampled.run.place, one.sampled.run.payload) for one in runs)


def _known_payloads(trained: Sequence[Observed], tried: Sequence[Observed]) -> dict[str, Payload]:
    """Of all runs; raises InputError where a run is tried whose payload nothing tells."""
    result = _payloads((*trained, *tried))
    for one in tried:
        payload = one.sampled.run.payload
        if payload is not None and payload.sought and payload.name not in _payloads(trained):
            problem = f"payload {payload.name} is not on any run that is identified from"
            raise InputError(one.sampled.run.place, problem, f"values of {' '.join(payload.sought)} in the sidecar")
    return result


def _check_rows(factors: Sequence[Factor], runs: Sequence[Sampled]) -> None:
    """Raises InputError where no joint has a row."""
    if any(one.rows for one in factors):
        return
    place = runs[0].run.place
    if any(run.spoiled(one.joint) for run in runs for one in factors):
        raise InputError(place, f"no row is left: {SPOILED}", "longer stretches without any, a smaller factor")
    slow = "no row is left: joints are never faster than the standstill threshold"
    raise InputError(place, slow, "faster motion, a smaller threshold")


def _problem(
    factors: tuple[Factor, ...],
    base: Sequence[str],
    payloads: Mapping[str, Payload],
    recipe: Recipe,
    options: Options,
) -> Problem:
    """For the parameters named in ``base`` and those of the payloads, but for what is known or fixed."""
    names = [*base, *(name for one in payloads.values() for name in one.names().values())]
    fixed = {name: value for one in payloads.values() for name, value in one.fixed.items()}
    fixed |= options.fixed
    free = tuple(name for name in names if name not in fixed)
    weighted = recipe.weights == recipes.JOINT
    return Problem(factors, free, fixed, weighted, recipe.freedom == recipes.SAMPLES)


def _separable(problem: Problem, payloads: Mapping[str, Payload]) -> tuple[Problem, list[str]]:
    """Without the payloads' parameters that others hold, and with them those that no row shows: such a payload counts
    as part of the last body.

    What shows only in sums of a payload's own parameters stays: zero would contradict the runs.
    """
    notes = []
    for payload in payloads.values():
        own = tuple(payload.names().values())
        others = tuple(name for name in problem.names if name not in own)
        solution = problem.solve()
        held = [name for name in own if name in solution.hidden and problem.hold(name, others)]
        shown = [name for name in held if solution.values[name]]
        if shown:
            notes.append(
                f"payload {payload.name}: no run without it tells {' '.join(shown)} from the last body, "
                "whose parameters hold them"
            )
            for name in held:
                problem = problem.without(name)
    return problem, notes


def _solved(problem: Problem, runs: Sequence[Observed], options: Options) -> tuple[Problem, Solution, list[str]]:
    """The problem with rows that are outliers weighed down, its solution with the standard deviations that are asked
    for, and what is to be told.
    """
    rows: Callable[[Observed], Iterable[Rows]] = Observed.rows
    notes = []
    if options.robust:
        found = robust(problem, runs)
        notes.append(f"{found.outliers} of {sum(one.rows for one in problem.factors)} rows count less than fully")
        problem, rows = found.problem, found.rows
    solution = problem.solve()
    if options.draws:
        solution = bootstrapped(problem, solution, runs, options.draws, rows)
    return problem, solution, notes


def _estimate(problem: Problem, solution: Solution, train: Sequence[Factor], test: Sequence[Factor]) -> Estimate:
    tried = residuals(test, solution.values) if test else None
    return Estimate(solution, problem.names, residuals(train, solution.values), tried)


def _notes_on(one: Observed, robot: Robot, recipe: Recipe) -> list[str]:
    notes = notes_of(one.sampled.run, recipe)
    name = one.sampled.run.name
    slow, spoiled = list[str](), list[str]()
    for factor in one.factors:
        number, still = robot.moving[factor.joint].number, factor.joint in one.sampled.still
        if still:
            rows = "" if factor.rows else ", and its dry friction may be any: it has no rows"
            notes.append(f"{name}: joint {number} stands still; its speed was taken as zero{rows}")
        elif not factor.rows:
            (spoiled if one.sampled.spoiled(factor.joint) else slow).append(f"joint {number}")
    if slow:
        verb, they_have = ("is", "it has") if len(slow) == 1 else ("are", "they have")
        notes.append(f"{name}: {listed(slow)} {verb} never faster than the standstill threshold; {they_have} no rows")
    if spoiled:
        verb = "has" if len(spoiled) == 1 else "have"
        notes.append(f"{name}: {listed(spoiled)} {verb} no rows: {SPOILED}")
    return notes


def _doubts(regressors: Regressors, full: Estimate, best: Estimate) -> list[str]:
    """Parameters that nothing shows, and those that matter cannot have; tests and the essential parameters' ``best``
    fit where they leave far more than the ``full`` model of the fitted runs.
    """
    solution = full.solution
    notes = not_shown(solution.hidden, "motion in the data")
    notes += shown_together([name for name in regressors.names if name in solution.hidden], solution.values)
    for parameter in regressors.model.base_parameters:
        name = parameter.name
        if parameter.lower is None or name not in full.sought or name in solution.hidden:
            continue
        below = parameter.lower - solution.values[name]
        if below > 3 * solution.std(name) and np.isfinite(below):
            notes.append(f"{name} is {solution.values[name]:.4g}, below its bound {parameter.lower:g}")
    if full.test is not None:
        notes += beyond(full.train, full.test, regressors.model.robot.numbers)
    if best.train.total.norm > _COSTLY * full.train.total.norm:
        notes.append("the essential parameters leave far more of the torques than all do; a larger ratio keeps more")
    return notes
