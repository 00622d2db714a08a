"""The diagnosis from files to files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from generator.cli.progress import stage
from generator.robot.description import Robot
from generator.writing import replace
from identification import recipe as recipes
from identification.dataset import load
from identification.diagnosis.diagnosis import Diagnosis, diagnose
from identification.diagnosis.prepared import prepared
from identification.diagnosis.priors import prior_of
from identification.diagnosis.results import document
from identification.diagnosis.roles import roles
from identification.observation import Regressors
from identification.results import written

#: Name of the machine-readable result.
RESULTS = "diagnosis.json"


def diagnosed(
    path: Path,
    robot: Robot,
    data: Sequence[str],
    validate: Sequence[str],
    test: Sequence[str],
    prior: str | None,
    folder: Path,
    dry: bool = False,
) -> tuple[Diagnosis, list[str]]:
    """The diagnosis of the robot file ``path`` by runs, and the names of the files written into ``folder``.

    Raises InputError for runs and parameter sets that cannot be used.
    """
    regressors = Regressors(robot)
    known = None if prior is None else prior_of(regressors.model, prior)
    recipe = recipes.recipe_of(robot.name)
    with stage(f"reading {len(data) + len(validate) + len(test)} runs"):
        first = [load(source, robot, recipe.columns) for source in data]
        chosen = roles(first, validate, test)
        # A part of a run that is good as a whole may stand still.
        runs = [
            prepared(load(source, robot, recipe.columns, resting=source not in data), recipe, regressors)
            for source in (*chosen.train, *chosen.validate)
        ]

    def told(text: str) -> None:
        with stage(text):
            pass

    found = diagnose(regressors, runs, chosen, known, told)
    replace(folder, {RESULTS: written(document(found)).encode()})
    return found, [RESULTS]
