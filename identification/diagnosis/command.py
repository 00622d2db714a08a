"""The diagnosis from files to files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from generator.cli.progress import stage
from generator.robot.description import Robot
from generator.writing import replace
from identification import recipe as recipes
from identification.dataset import load
from identification.diagnosis.diagnosis import Diagnosis, diagnose
from identification.diagnosis.mending import Mended, mended
from identification.diagnosis.prepared import prepared
from identification.diagnosis.priors import prior_of
from identification.diagnosis.results import document
from identification.diagnosis.roles import roles
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

    Raises InputError for runs and parameter sets that cannot be used.
    """
    regressors = Regressors(robot)
    known = None if wanted.prior is None else prior_of(regressors.model, wanted.prior)
    recipe = recipes.recipe_of(robot.name)
    with stage(f"reading {len(wanted.data) + len(wanted.validate) + len(wanted.test)} runs"):
        first = [load(source, robot, recipe.columns) for source in wanted.data]
        chosen = roles(first, wanted.validate, wanted.test)
        # A part of a run that is good as a whole may stand still.
        runs = [
            prepared(load(source, robot, recipe.columns, resting=source not in wanted.data), recipe, regressors)
            for source in (*chosen.train, *chosen.validate)
        ]

    def told(text: str) -> None:
        with stage(text):
            pass

    found = diagnose(regressors, runs, chosen, known, told, wanted.dry)
    new = None if wanted.dry else mended(path, found, wanted.prior, folder, stage)
    with stage("writing the report"):
        files = {RESULTS: written(document(found, new)).encode(), **pages(found, new)}
        replace(folder, files)
    made = [] if new is None else [f"{robot.name}.yaml", "generated"]
    return found, new, [*files, *made]
