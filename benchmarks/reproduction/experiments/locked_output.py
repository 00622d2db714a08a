"""KR270-2F: stiffness of axes 1 and 2 with their output blocked (section 5.2)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from benchmarks.reproduction.experiment import Estimate, Found, saved
from generator.resources import find_robot
from generator.robot.readers import read
from identification import locked_output as method
from identification.drive_train import with_constants
from identification.recipes import Recipe
from identification.simulation.machine import compiled
from identification.simulation.settings import Settings
from identification.simulation.simulate import Simulated, noisy, simulate

TITLE = "KR270-2F, stiffness with a blocked output"
COVERING = ("k1", "k2", "k1, all", "k2, all")

#: Section 5.2: the decimation passes 1 Hz. What it asks of the Butterworth filter is not said.
REPORTED = Recipe(cutoff=20.0, factor=100)
#: Poses near those whose offsets Tables 9 and 10 print: q1 = 1.555 rad, q2 = -1.54 rad.
POSES = {1: (1.555, -0.05, 0.0, 0.0, 0.0, 0.0), 2: (0.0, -1.54, 0.0, 0.0, 0.0, 0.0)}
#: Rms of the currents' noise [A] with which the residuals are those printed below Tables 9 and 10, 2.12 and 3.58 %.
NOISE = {1: 2.0, 2: 2.4}
_STEMS = ("Iam", "Fvm", "Fcm", "k")


def play(seeds: Sequence[int], folder: Path) -> Iterator[Found]:
    """Of each axis the essential parameters with the report's filters, and all five with the defaults."""
    robot = read(find_robot("kr270"))
    with compiled(robot) as machine:
        runs = {
            number: simulate(
                machine,
                Settings(
                    trajectory="locked_output",
                    flexible=True,
                    pose=pose,
                    duration=60.0,
                    log_rate=250.0,
                    resolution=(1e-4,),
                    further=("qs",),
                ),
            )
            for number, pose in POSES.items()
        }
    for seed in seeds:
        models, residuals = {}, {}
        for number, run in runs.items():
            truth = _truth(run, number)
            calibrated = with_constants(robot, [run.parameters[f"kt{joint.number}"] for joint in robot.moving])
            path = saved(noisy(run, (NOISE[number],), seed=seed), robot, folder / f"axis{number}.csv")
            reported = method.locked_output(calibrated, number, [path], recipe=REPORTED)
            usual = method.locked_output(calibrated, number, [path])
            for name, values in ((f"k{number}", reported.essential), (f"k{number}, all", usual.values)):
                models[name] = tuple(
                    Estimate(parameter, one.unit, truth[parameter], one.value, one.std)
                    for parameter, one in values.items()
                    if one.value is not None
                )
            residuals[f"k{number}"] = (reported.essential_residual.relative_to_mean,)
        yield Found(models, residuals)


def _truth(run: Simulated, number: int) -> dict[str, float]:
    """Values of eq. 70 about the link's place: Offk = Offm - k q_link."""
    values = {f"{stem}{number}": run.parameters[f"{stem}{number}"] for stem in _STEMS}
    link = float(run.columns[f"qs{number}"].mean())
    values[f"Offk{number}"] = run.parameters[f"Offm{number}"] - values[f"k{number}"] * link
    return values
