"""KR500-2MT: stiffness and torque constants of axes 1 to 3 by steps of force, (section 6.4)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from benchmarks.reproduction.experiment import Estimate, Found, saved
from generator.resources import find_robot
from generator.robot.description import Robot
from generator.robot.readers import read
from identification import force_steps as method
from identification.simulation.machine import compiled
from identification.simulation.settings import Settings
from identification.simulation.simulate import Simulated, noisy, simulate

TITLE = "KR500-2MT, stiffness and torque constants by steps of force"
COVERING = ("stiffness", "torque constants")

#: In the first the force turns axes 2 and 3 alone, in the others axis 1 as well.
POSES = (
    (0.2, -1.2, 0.9, 0.0, 0.3, 0.0),
    (0.1, -1.3, 1.1, 1.2, 1.1, 0.3),
    (0.1, -1.0, 1.1, -1.2, 1.1, 0.3),
)
STEPS = {"force": 4000.0, "steps": 6}
#: Rms of the noise of the currents [A] and of the wrench [N, N m].
NOISE, WRENCH_NOISE = (1.5,), (400.0, 120.0)
#: What is told apart by the models' names: components that are not measured.
SENSORS = {"": (), ", fz alone": ("fx", "fy", "mx", "my", "mz")}
_SET = "pressed"


def play(seeds: Sequence[int], folder: Path) -> Iterator[Found]:
    """Stiffness and torque constants of all poses together."""
    robot = with_printed_constants(read(find_robot("kr500")))
    with compiled(robot) as machine:
        settings = Settings(
            trajectory="force_steps",
            trajectory_settings=STEPS,
            flexible=True,
            parameters=_SET,
            duration=60.0,
            log_rate=200.0,
            resolution=(1e-4,),
        )
        runs = [simulate(machine, replace(settings, pose=pose)) for pose in POSES]
    truth = runs[0].parameters
    inertias = {name: value for name, value in truth.items() if name.startswith("Iam")}
    generated = method.wrench_torque(robot)
    for seed in seeds:
        draws = [noisy(run, NOISE, WRENCH_NOISE, len(runs) * seed + k) for k, run in enumerate(runs)]
        models, residuals = {}, {}
        for suffix, unseen in SENSORS.items():
            paths = [saved(_without(unseen, run), robot, folder / f"pose{k}.csv") for k, run in enumerate(draws)]
            found = method.force_steps(robot, paths, inertias, generated=generated)
            for name, values, each in (
                ("stiffness", found.stiffness, found.residuals),
                ("torque constants", found.constants, found.motor_residuals),
            ):
                models[name + suffix] = tuple(
                    Estimate(one, value.unit, truth[one], value.value, value.std)
                    for one, value in values.items()
                    if value.value is not None
                )
                residuals[name + suffix] = tuple(one.relative_to_mean for one in each.values())
        yield Found(models, residuals)


def with_printed_constants(robot: Robot) -> Robot:
    """The robot with one more parameter set: its elastic twin with the torque constants of Table 16."""
    twin, printed = robot.parameter_sets["twin_flexible"], robot.parameter_sets["report_table_16"]
    pressed = replace(twin, name=_SET, values={**twin.values, **printed.values})
    return replace(robot, parameter_sets={**robot.parameter_sets, _SET: pressed})


def _without(names: Sequence[str], run: Simulated) -> Simulated:
    """The run without some of its columns."""
    return replace(run, columns={name: values for name, values in run.columns.items() if name not in names})
