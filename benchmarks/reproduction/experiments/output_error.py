"""KR500-2MT: output error in open loop by Gauss-Newton, from the runs of the inverse model (section 6.2)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from benchmarks.reproduction.experiment import Estimate, Found, saved
from benchmarks.reproduction.experiments.idim_ls import MOTION, NOISE
from generator.resources import find_robot
from generator.robot.readers import read
from identification.output_error.multi_start import output_error
from identification.output_error.results import parameters
from identification.output_error.search import Settings
from identification.recipes import Recipe
from identification.simulation.machine import compiled
from identification.simulation.simulate import noisy, simulate

TITLE = "KR500-2MT, output error by Gauss-Newton"
COVERING = ("full",)

#: Section 6.2: Butterworth of order 5 at 5 Hz, forward and backward.
SETTINGS = Settings(recipe=Recipe(cutoff=5.0, order=5), filtered=True)
#: The first period of the motion of section 6.1.
RUN = replace(MOTION, duration=10.0)


def play(seeds: Sequence[int], folder: Path) -> Iterator[Found]:
    """The full set of base parameters, and what is left of the positions."""
    robot = read(find_robot("kr500"))
    with compiled(robot) as machine:
        run = simulate(machine, RUN)
    for seed in seeds:
        path = saved(noisy(run, NOISE, seed=seed), robot, folder / "run.csv")
        found = output_error(robot, [path], settings=SETTINGS)
        estimates = tuple(
            Estimate(name, one.unit, run.parameters[name], one.value, one.std)
            for name, one in parameters(found).items()
            if one.value is not None
        )
        each = tuple(one.relative_to_mean for one in found.best.train.per_joint.values())
        yield Found({"full": estimates}, {"full": each})
