"""Design a motion that shows a robot's parameters well, before the robot moves.

The motion is a finite Fourier series of every joint within the limits of the robot file. DIR receives trajectory.csv
with times, wanted positions qr1 .. and speeds qd1 .., for a controller or "counterpoise simulate --trajectory played".
It also receives excitation.json and report.html, with the standard deviation that identification is expected to reach
for each base parameter.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from generator.bounds import above, not_negative, whole_number
from generator.cli.shared_arguments import takes_out, takes_robot
from generator.command_line import command_line
from generator.errors import InputError
from generator.progress import bar, stage
from generator.resources import find_robot
from generator.review.words import listed
from generator.writing import spare, writable
from identification.extras import needing

if TYPE_CHECKING:
    from generator.robot.description import Robot
    from identification.excitation.results import Excitation
    from identification.observation import Regressors

#: Rows that a motion may have; difference of two frequencies that is rounding, in parts of one.
_MOST, _SAME = 1e7, 1e-9
#: Least noise that is one, and largest noise, speed and acceleration [SI]: beyond, squares overflow.
_LEAST, _LARGEST = 1e-12, 1e12


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT, the motion, its limits, what is known and measured, the search."""
    takes_robot(parser)
    takes_out(parser, "where the files go (default: excitation/ROBOT)")
    parser.add_argument(
        "--parameters", metavar="SET", default="twin", help="parameter set of the robot file (default: twin)"
    )
    _motion(parser.add_argument_group("motion"))
    _measured(parser.add_argument_group("what is measured"))
    _search(parser.add_argument_group("search"))


def _motion(group: argparse._ActionsContainer) -> None:
    group.add_argument("--frequency", metavar="HZ", type=float, default=0.1, help="lowest frequency (default: 0.1)")
    group.add_argument("--harmonics", metavar="N", type=int, default=5, help="number of its multiples (default: 5)")
    group.add_argument("--periods", metavar="N", type=int, default=2, help="periods in the run (default: 2)")
    group.add_argument(
        "--rate", metavar="HZ", type=float, default=1000.0, help="sampling rate of the run and its log (default: 1000)"
    )
    group.add_argument(
        "--speed",
        metavar="RAD/S",
        type=float,
        help="largest speed of any joint [rad/s, m/s] (default: the file's limit, else 1)",
    )
    group.add_argument(
        "--acceleration",
        metavar="RAD/S2",
        type=float,
        help="largest acceleration of any joint [rad/s2, m/s2] (default: the file's limit, else 2)",
    )


def _measured(group: argparse._ActionsContainer) -> None:
    group.add_argument(
        "--noise",
        metavar="A",
        type=float,
        nargs="+",
        help="rms of the noise, one value or one per motor [A; N m or N without torque constants]",
    )
    group.add_argument(
        "--noise-part",
        metavar="R",
        type=float,
        help="rms of the model's error, in parts of the rms torque of random motions (default: 0.02 without --noise)",
    )
    group.add_argument(
        "--recipe", metavar="FILE", type=Path, help="a YAML file with the filters' settings (default: as for identify)"
    )


def _search(group: argparse._ActionsContainer) -> None:
    group.add_argument(
        "--criterion",
        choices=("determinant", "condition"),
        default="determinant",
        help="what makes a motion good (default: determinant)",
    )
    group.add_argument("--evaluations", metavar="N", type=int, default=20000, help="motions to try (default: 20000)")
    group.add_argument("--seed", metavar="N", type=int, default=0, help="seed of the search (default: 0)")


def run(arguments: argparse.Namespace) -> None:
    """Designs, writes the files, prints a summary."""
    from generator.robot.readers import read

    with needing(command_line("counterpoise excite")):
        from identification.excitation.results import BESIDE, RUN, save
        from identification.observation import Regressors
        from identification.report.excite.report import report
        from identification.report.page import REPORT

    _check(arguments)
    path = find_robot(arguments.robot)
    robot = read(path)
    folder = arguments.out or Path("excitation") / robot.name
    writable(folder)
    for source in (path, arguments.recipe):
        if source is not None and os.path.exists(source):
            spare(source, [folder / RUN, folder / BESIDE])
    _check_noise(arguments, robot)
    with stage(f"deriving the model of {path.stem}"):
        regressors = Regressors(robot)
    found = _designed(arguments, robot, regressors)
    files = save(found, folder, {REPORT: report(found)})
    print(_summary(found, arguments.frequency))
    print(f"files            {', '.join(files)} in {folder}/")


def _check(arguments: argparse.Namespace) -> None:
    from identification.excitation.design import DRAWN

    for option, value in (("--frequency", arguments.frequency), ("--rate", arguments.rate)):
        above(value, option, 0)
    for option, value in (("--speed", arguments.speed), ("--acceleration", arguments.acceleration)):
        if value is not None:
            above(value, option, 0, _LARGEST)
    for option, count, least, most in (
        ("--harmonics", arguments.harmonics, 2, 50),
        ("--periods", arguments.periods, 1, 1000),
        ("--evaluations", arguments.evaluations, DRAWN, 10**7),
        ("--seed", arguments.seed, 0, 2**63),
    ):
        whole_number(count, option, least, most)
    if not (samples := arguments.periods / arguments.frequency * arguments.rate) <= _MOST:
        problem = f"{arguments.periods} periods of {1 / arguments.frequency:g} s make {samples:g} rows"
        raise InputError(command_line("--periods"), problem, f"at most {_MOST:g}")
    fastest = arguments.frequency * arguments.harmonics
    if arguments.rate < 20 * fastest:
        raise InputError(
            command_line("--rate"), f"{arguments.rate:g}", f"20 times the highest harmonic, {fastest:g} Hz"
        )


def _rows_of_a_period(arguments: argparse.Namespace) -> int:
    """The nearest whole number: only then do logs repeat sample by sample."""
    result: int = round(arguments.rate / arguments.frequency)
    return result


def _check_noise(arguments: argparse.Namespace, robot: Robot) -> None:
    n = len(robot.moving)
    noise, part = arguments.noise or [], arguments.noise_part
    if len(noise) not in (0, 1, n):
        raise InputError(
            command_line("--noise"), f"{len(noise)} numbers", "one" if n == 1 else f"one, or one for each of {n} motors"
        )
    for option, value in (*(("--noise", one) for one in noise), ("--noise-part", 0.0 if part is None else part)):
        if not_negative(value, option, _LARGEST):
            above(value, option, _LEAST, _LARGEST)
    if not part and noise and not all(noise):
        raise InputError(command_line("--noise"), "a motor without noise", "noise on every motor, or --noise-part")
    if part == 0 and not noise:
        raise InputError(command_line("--noise-part"), "0, and no --noise", "a measurement that is not exact")


def _designed(arguments: argparse.Namespace, robot: Robot, regressors: Regressors) -> Excitation:
    import numpy as np

    from identification import recipe as recipes
    from identification.excitation.criterion import Criterion
    from identification.excitation.design import designed, usual_torques
    from identification.excitation.expectation import expected
    from identification.excitation.limits import limits_of
    from identification.excitation.memory import Memory
    from identification.excitation.noise import PART, noise_of
    from identification.excitation.results import Excitation
    from identification.excitation.shapes import Shapes
    from identification.named_set import resolved_set

    recipe = recipes.recipe_of(robot.name, arguments.recipe)
    filters = recipe.at(arguments.rate)
    # The last row is the end of the last period, at rest again.
    samples = arguments.periods * _rows_of_a_period(arguments) + 1
    if samples < filters.fewest:
        problem = f"{samples} samples at {arguments.rate:g} Hz"
        raise InputError(command_line("--periods"), problem, f"at least {filters.fewest} for the filters")
    values = resolved_set(regressors.model, arguments.parameters, command_line("--parameters"))
    regressors = regressors.loaded_by(values)
    part = arguments.noise_part if arguments.noise_part is not None else 0.0 if arguments.noise else PART
    limits = limits_of(robot, arguments.speed, arguments.acceleration)
    shapes = Shapes(limits, arguments.rate / _rows_of_a_period(arguments), arguments.harmonics)
    memory = Memory(regressors, values, shapes.frequency, arguments.periods)
    usual = usual_torques(shapes, memory, arguments.seed)
    noise = noise_of(robot, arguments.noise or [0.0], part, usual)
    standstill = recipe.standstills(robot)
    judge = Criterion(memory, limits, noise, standstill, filters.factor, arguments.criterion)
    with bar(f"searching among {arguments.evaluations} motions") as progress:
        design = designed(judge, shapes, arguments.evaluations, arguments.seed, progress)
    motion = memory.completed(design.series.motion(np.arange(samples) / arguments.rate), 1 / arguments.rate)
    return Excitation(
        robot=robot,
        design=design,
        limits=limits,
        noise=noise,
        motion=motion,
        rate=arguments.rate,
        periods=arguments.periods,
        filters=filters,
        expected=expected(motion, arguments.rate, regressors, recipe, values, noise),
        units={one.name: one.unit for one in regressors.model.base_parameters},
        parameters=arguments.parameters,
        criterion=arguments.criterion,
        evaluations=arguments.evaluations,
        seed=arguments.seed,
    )


def _summary(found: Excitation, asked: float) -> str:
    solution = found.expected
    lines = [f"{found.robot.name}: {found.duration:g} s at {found.rate:g} Hz, {len(found.units)} base parameters"]
    frequency = found.design.series.frequency
    if abs(frequency / asked - 1) > _SAME:
        lines.append(f"note: {frequency:.6g} Hz for {asked:g}: a period is a whole number of samples")
    if solution.hidden:
        lines.append(f"note: {listed(solution.hidden)} will not be identifiable from this motion")
    width = max(map(len, [*found.units, "parameter"]))
    lines.append(f"{'parameter'.ljust(width)} {'value':>12} {'std':>10} {'std %':>9}  unit")
    for name, unit in found.units.items():
        lines.append(
            f"{name.ljust(width)} {solution.values[name]:>12.6g} {solution.std(name):>10.4g} "
            f"{solution.relative_std(name):>9.4g}  {unit}"
        )
    lines.append(
        f"condition of W   {solution.condition:.6g}, with columns of unit length {solution.scaled_condition:.6g}"
    )
    load = f"{100 * found.design.load:.1f} % of the tightest" if found.limits.loads.size else "none in the robot file"
    lines.append(f"torque limits    {load}")
    return "\n".join(lines)
