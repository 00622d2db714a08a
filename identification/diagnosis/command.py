"""The diagnosis from files to files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from dataclasses import replace as changed
from pathlib import Path

from generator.errors import InputError
from generator.progress import stage, stages
from generator.robot.description import Robot
from generator.words import plural
from generator.writing import replace, replacing
from identification import recipes
from identification.dataset import Run, load
from identification.destination import spare_inputs
from identification.diagnosis.columns.priors import notes_of, preferring, prior_of
from identification.diagnosis.diagnosis import Diagnosis, diagnose
from identification.diagnosis.mending.mended import GENERATED, Mended, mended
from identification.diagnosis.noise import effort_rounding, noise_floor, torque_band
from identification.diagnosis.plausibility import explained, of_one_sign
from identification.diagnosis.results import document
from identification.diagnosis.runs.prepared import Prepared, prepared
from identification.diagnosis.runs.roles import Roles, roles
from identification.observation import Regressors
from identification.results import written

#: Name of the machine-readable result.
RESULTS = "diagnosis.json"


@dataclass(frozen=True)
class Request:
    """Runs by role, the set that is known beforehand (None: all is fitted); ``dry`` only locates."""

    data: Sequence[str]
    validate: Sequence[str] = ()
    test: Sequence[str] = ()
    prior: str | None = None
    dry: bool = False


def diagnosed(
    path: Path,
    robot: Robot,
    wanted: Request,
    folder: Path,
    pages: Callable[[Diagnosis, Mended | None], Mapping[str, bytes]],
) -> tuple[Diagnosis, Mended | None, list[str]]:
    """The diagnosis of the robot file ``path``, the mended robot, and the names of what was written into ``folder``.

    ``pages`` makes the report by the file's name: reports know the diagnosis, which knows none of them.

    Everything is written at the end, or nothing. Raises InputError for runs, parameter sets and folders that cannot be
    used, for swapped columns and torques of another sign (``plausibility.of_one_sign``), and for a ``folder`` in which
    the mended robot would replace a file that is read, before anything is looked for; and at the end, unless it is a
    dry request, for runs that are not of this robot (``plausibility.explained``).
    """
    if not wanted.dry:
        spare_inputs(folder, robot, (path,), (*wanted.data, *wanted.validate, *wanted.test))
    with stage(f"deriving the model of {robot.name}"):
        regressors = Regressors(preferring(robot, wanted.prior))
    prior = None if wanted.prior is None else prior_of(regressors.model, wanted.prior)
    notes = [] if wanted.prior is None else notes_of(regressors.model, wanted.prior)
    given = _runs(wanted, robot, regressors)
    notes += [note for run in given.recorded for note in run.notes]
    tests = given.tests if given.roles.untouched else ()
    of_one_sign([*given.runs, *tests], regressors, prior)

    with replacing(folder, GENERATED) as fresh:
        with stages() as progress:
            found = diagnose(regressors, given.runs, given.roles, prior, progress, wanted.dry, tests)
        ended = [*(() if wanted.dry else explained(found)), *_of_noise(found, wanted.dry)]
        found = changed(found, notes=(*notes, *found.notes, *ended))
        new = None if wanted.dry else mended(path, found, wanted.prior, fresh, stage)
        with stage("writing the report"):
            files = {RESULTS: written(document(found, new)).encode(), **pages(found, new)}
            replace(fresh, files)
    made = [] if new is None else [f"{robot.name}.yaml", GENERATED]
    return found, new, [*files, *made]


@dataclass(frozen=True)
class _Runs:
    """All runs as they were ``recorded`` and their roles; by the diagnosis' filters those that are fitted or validate,
    and the ``tests``.
    """

    recorded: Sequence[Run]
    roles: Roles
    runs: Sequence[Prepared]
    tests: Sequence[Prepared]


def _runs(wanted: Request, robot: Robot, regressors: Regressors) -> _Runs:
    """The runs that are asked for; raises InputError where one cannot be used, even if it is only played at the end."""
    recipe = recipes.recipe_of(robot.name)

    def read(sources: Sequence[str], resting: bool = True) -> list[Run]:
        return [load(source, robot, recipe.columns, resting=resting) for source in sources]

    def looked_at(sources: Sequence[str]) -> list[Prepared]:
        # A part of a run that is good as a whole may stand still.
        parts = [whole[source] if source in whole else read([source])[0] for source in sources]
        return [prepared(run, recipe, regressors) for run in parts]

    with stage(f"reading {plural(len(wanted.data) + len(wanted.validate) + len(wanted.test), 'run')}"):
        fit, validating, last = read(wanted.data, resting=False), read(wanted.validate), read(wanted.test)
        kinds = [joint.sigma for joint in robot.moving]
        chosen = roles(fit, validating, last, tested=not wanted.dry, kinds=kinds)
        recorded = (*fit, *validating, *last)
        whole = {run.name: run for run in recorded}
        train = looked_at(chosen.train)
        runs = [*train, *looked_at(chosen.validate)]
        if not any(run.kept.any() for run in train):
            raise InputError(fit[0].place, "no joint moves in the runs that are fitted", "runs in motion")
        return _Runs(recorded, chosen, runs, looked_at(chosen.test))


def _of_noise(found: Diagnosis, dry: bool) -> list[str]:
    """What is to be told of the torques' band, rounding and noise, behind which effects may stay hidden."""
    bank = found.search.bank
    narrow = [] if dry else torque_band.notes([bank.scenes[r] for r in found.search.train])
    known_in_part = [k for k, one in enumerate(found.after.lack) if one.follows]
    floor = noise_floor.notes(bank, {*effort_rounding.told(bank), *known_in_part})
    return [*narrow, *effort_rounding.notes(bank), *floor]
