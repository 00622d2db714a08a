"""Output error from the inverse model's estimate, and from random starts about it, on any executor, resumable."""

from __future__ import annotations

import atexit
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import asdict, dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from generator.errors import InputError, Place
from generator.robot.description import Robot
from generator.version import VERSION
from identification import recipes
from identification.arrays import Array
from identification.dataset import load
from identification.executors import Executor
from identification.executors.here import Here
from identification.inverse_model import Identification, Options, identify
from identification.least_squares import not_shown
from identification.output_error.criterion import Criterion, Point
from identification.output_error.estimate import Estimate, evaluated
from identification.output_error.experiment import Experiment, experiment
from identification.output_error.methods import methods
from identification.output_error.search import Minimum, Search, Settings, search_of, starts
from identification.set_values import shown_together
from identification.simulation.machine import Machine, compiled
from identification.study import Counted, key_of, study

#: Folder of the results of single starts.
STARTS = "starts"
#: Keys of such a result.
_RESULT = ("chi", "states", "scale", "rms", "simulations", "iterations", "settled")
#: What is told of the best start where its search was cut short.
_UNSETTLED = (
    "the search of the best start came to its last iteration or second before it settled: its values may be further "
    "off than their standard deviations say, more iterations or seconds take it to its end"
)


@dataclass(frozen=True)
class Start:
    """One task: a search, in what a worker needs to make it, and where it begins."""

    robot: Robot
    experiments: tuple[Experiment, ...]
    values: Mapping[str, float]
    std: Mapping[str, float]
    settings: Settings
    chi: tuple[float, ...]


@dataclass(frozen=True)
class OutputError:
    """The ``best`` of all starts with the inverse model's ``first`` estimate, runs and repairs.

    ``scores`` are the starts' criteria by name: the logarithm of the geometric mean of the joints' rms position errors
    where joints are weighted, else the rms of all; infinite where the simulation diverges.
    """

    robot: Robot
    settings: Settings
    first: Identification
    train: tuple[Experiment, ...]
    test: tuple[Experiment, ...]
    scores: Mapping[str, float]
    chosen: str
    best: Estimate
    notes: tuple[str, ...]


def output_error(
    robot: Robot,
    data: Sequence[str | Path],
    test: Sequence[str | Path] = (),
    settings: Settings | None = None,
    *,
    count: int = 1,
    executor: Executor | None = None,
    folder: Path | None = None,
    counted: Counted = lambda done, total: None,
) -> OutputError:
    """Parameters of ``robot`` from the runs ``data`` by output error, the best of ``count`` starts.

    The first start is what the inverse model identifies from the same runs, the others are drawn about it. They run on
    the ``executor``, one after the other where there is none; ``counted`` is told how many are done. ``folder`` keeps
    the result of each start as it comes; a start whose result is there already is not run again.

    Raises InputError for runs that cannot be used.
    """
    settings = settings or Settings(recipe=recipes.recipe_of(robot.name))
    first = identify(robot, data, test, Options(recipe=settings.recipe, fixed=settings.fixed))
    if first.regressors.reads_load:
        raise InputError(robot.place, "friction by load makes the model not linear", "a robot file without it")
    train, tried = (
        tuple(
            experiment(
                load(str(one), robot, settings.recipe.columns),
                robot,
                settings.recipe,
                settings.segment,
                settings.filtered,
            )
            for one in sources
        )
        for sources in (data, test)
    )
    solution = first.full.solution
    std = {name: solution.std(name) for name in solution.values}
    machine = machine_of(Made(robot.digest, robot))
    search, chi = search_of(machine.module, train, solution.values, std, settings)
    tasks = {
        name: Start(robot, train, solution.values, std, settings, tuple(one.tolist()))
        for name, one in starts(search, chi, count).items()
    }
    kept = None if folder is None else folder / STARTS / _key(tasks["start_001"])
    results = study(run_start, tasks, executor or Here(), kept, counted, _RESULT)
    if kept is not None:
        _check_kept(results, search.criterion, chi, kept)
    scores = {name: _score(search, np.array(one["rms"])) for name, one in results.items()}
    chosen = min(scores, key=lambda name: scores[name])
    best = evaluated(search, _minimum(search, results[chosen]), tried)
    # What no torque shows no position shows.
    hidden = [name for name in best.names if name in best.hidden or name in solution.hidden]
    best = replace(best, hidden=tuple(hidden))
    return OutputError(robot, settings, first, train, tried, scores, chosen, best, _notes(first, best, train))


def _check_kept(results: Mapping[str, Any], criterion: Criterion, chi: Array, folder: Path) -> None:
    """Raises InputError for one of the ``results`` in ``folder`` whose numbers are not as many as a search leaves."""
    first = criterion.begin(chi).states
    like: dict[str, Array | float] = {
        "chi": chi,
        "scale": criterion.scale,
        "rms": criterion.scale,
        "simulations": 0,
        "iterations": 0,
        "settled": True,
    }
    for name, one in results.items():
        states = one["states"] if isinstance(one["states"], list) else []
        whole = len(states) == len(first) and all(map(_alike, states, first))
        if not (whole and all(_alike(one[key], value) for key, value in like.items())):
            place = Place(str(folder / f"{name}.json"))
            raise InputError(place, "these are not the numbers of a start", "a file that output-error wrote")


def _alike(found: object, like: Array | float) -> bool:
    """Whether a JSON value has numbers or truths alone, in the shape of ``like``."""
    try:
        numbers = np.array(found)
    except ValueError:
        return False
    return numbers.dtype.kind in ("b" if like is True else "if") and numbers.shape == np.shape(like)


def run_start(start: Start) -> dict[str, Any]:
    """The minimum from one start, as JSON values; the robot is compiled once in each process."""
    machine = machine_of(Made(start.robot.digest, start.robot))
    search, _ = search_of(machine.module, start.experiments, start.values, start.std, start.settings)
    found = methods()[start.settings.method].minimise(search, np.array(start.chi))
    return {
        "chi": found.point.chi.tolist(),
        "states": [one.tolist() for one in found.point.states],
        "scale": found.criterion.scale.tolist(),
        "rms": found.rms.tolist(),
        "simulations": found.simulations,
        "iterations": found.iterations,
        "settled": found.settled,
    }


@dataclass(frozen=True)
class Made:
    """A robot, the same as another one whose file says the same."""

    digest: str
    robot: Robot = field(compare=False)


@lru_cache(maxsize=4)
def machine_of(made: Made) -> Machine:
    """The robot's compiled simulation, kept while the process lives: compiling takes longer than a search."""
    stack = ExitStack()
    machine = stack.enter_context(compiled(made.robot))
    atexit.register(stack.close)
    return machine


def _key(start: Start) -> str:
    """Hash of all that the starts' results depend on."""
    settings = {name: value for name, value in asdict(start.settings).items() if name != "recipe"}
    return key_of(
        {
            "version": VERSION,
            "robot": start.robot.digest,
            "runs": [[one.run.name, one.digest, asdict(one.filters)] for one in start.experiments],
            "weights": start.settings.recipe.weights,
            "settings": settings,
            "start": list(start.chi),
        }
    )


def _minimum(search: Search, result: Mapping[str, Any]) -> Minimum:
    point = Point(np.array(result["chi"]), tuple(np.array(one) for one in result["states"]))
    criterion = replace(search.criterion, scale=np.array(result["scale"]))
    return Minimum(point, criterion, result["simulations"], result["iterations"], result["settled"])


def _score(search: Search, rms: Array) -> float:
    return float(np.log(rms).mean() if search.weighted else np.sqrt((rms**2).mean()))


def _notes(first: Identification, best: Estimate, runs: Sequence[Experiment]) -> tuple[str, ...]:
    solution = first.full.solution
    of_other_values = shown_together([name for name in best.names if name in solution.hidden], solution.values)
    notes = [note for note in first.notes if not note.startswith("the essential parameters")]
    notes = [note for note in notes if note not in of_other_values]
    for one in runs:
        unused = one.motion.samples - one.tau.shape[0] * one.tau.shape[1]
        if unused * one.period >= 0.1:
            notes.append(f"{one.run.name}: {unused * one.period:.3g} s are not part of any segment")
    if not best.settled:
        notes.append(_UNSETTLED)
    if best.limited:
        notes.append("the constraint that M(q) is positive definite holds; standard deviations are those without it")
    if best.test is not None and not np.isfinite(best.test.total.norm):
        notes.append("the simulation diverges on what was held out: shorter segments follow it further")
    notes += not_shown(best.hidden, "position")
    notes += shown_together(best.hidden, best.values)
    return tuple(dict.fromkeys(notes))
