"""KR500-2MT: inverse model and least squares, with the maker's torque constants (section 6.1)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from benchmarks.reproduction.experiment import Estimate, Found, saved
from generator.resources import find_robot
from generator.robot.readers import read
from identification import inverse_model
from identification.inverse_model import Options, identify
from identification.observation import Regressors
from identification.recipes import Recipe
from identification.simulation.machine import compiled
from identification.simulation.settings import Settings
from identification.simulation.simulate import noisy, simulate

TITLE = "KR500-2MT, inverse model and least squares"
COVERING = ("full",)

#: Sections 5.1 and 6.1: Butterworth at 50 Hz, decimation that passes 5 Hz.
RECIPE = Recipe(cutoff=50.0, factor=80)
MOTION = Settings(
    trajectory_settings={"frequency": 0.1, "harmonics": 5, "speed": 1.5, "acceleration": 4.0},
    duration=20.0,
    seed=1,
    resolution=(1e-4,),
)
#: Rms of the currents' noise [A] with which the residuals are those of Table 12.
NOISE = (5.5, 4.0, 5.0, 2.8, 3.6, 1.8)


def play(seeds: Sequence[int], folder: Path) -> Iterator[Found]:
    """The full set of base parameters, and the essential ones."""
    robot = read(find_robot("kr500"))
    regressors = Regressors(robot)
    with compiled(robot) as machine:
        run = simulate(machine, MOTION)
    for seed in seeds:
        path = saved(noisy(run, NOISE, seed=seed), robot, folder / "run.csv")
        found = identify(robot, [path], options=Options(recipe=RECIPE), regressors=regressors)
        models = {"full": found.full, "essential": found.essential}
        yield Found(
            {name: estimates(one, run.parameters, regressors) for name, one in models.items()},
            {name: tuple(r.relative_to_mean for r in one.train.per_joint.values()) for name, one in models.items()},
        )


def estimates(
    model: inverse_model.Estimate, truth: Mapping[str, float], regressors: Regressors
) -> tuple[Estimate, ...]:
    """Those of one model of an identification."""
    units = {parameter.name: parameter.unit for parameter in regressors.model.base_parameters}
    solution = model.solution
    return tuple(
        Estimate(name, units[name], truth[name], solution.values[name], solution.std(name)) for name in model.sought
    )
