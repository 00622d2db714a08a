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

from generator.cli.shared_arguments import takes_out, takes_robot
from generator.command_line import command_line
from generator.progress import bar, stage
from generator.resources import find_robot
from generator.words import listed
from generator.writing import spare, writable
from identification.default_sets import RIGID
from identification.extras import needing

if TYPE_CHECKING:
    from identification.excitation.results import Excitation

#: Difference of two frequencies that is rounding, in parts of one.
_SAME = 1e-9


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT, the motion, its limits, what is known and measured, the search."""
    takes_robot(parser)
    takes_out(parser, "where the files go (default: excitation/ROBOT)")
    parser.add_argument(
        "--parameters", metavar="SET", default=RIGID, help="parameter set of the robot file (default: %(default)s)"
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
        from identification import recipes
        from identification.excitation.checks import check
        from identification.excitation.excite import excite
        from identification.excitation.request import Request
        from identification.excitation.results import BESIDE, RUN, save
        from identification.observation import Regressors
        from identification.report.excite.report import report
        from identification.report.page import REPORT

    path = find_robot(arguments.robot)
    robot = read(path)
    request = Request(
        parameters=arguments.parameters,
        frequency=arguments.frequency,
        harmonics=arguments.harmonics,
        periods=arguments.periods,
        rate=arguments.rate,
        speed=arguments.speed,
        acceleration=arguments.acceleration,
        noise=arguments.noise or (),
        noise_part=arguments.noise_part,
        recipe=recipes.recipe_of(robot.name, arguments.recipe),
        criterion=arguments.criterion,
        evaluations=arguments.evaluations,
        seed=arguments.seed,
    )
    check(request, robot)
    folder = arguments.out or Path("excitation") / robot.name
    writable(folder)
    for source in (path, arguments.recipe):
        if source is not None and os.path.exists(source):
            spare(source, [folder / RUN, folder / BESIDE])
    with stage(f"deriving the model of {path.stem}"):
        regressors = Regressors(robot)
    with bar(f"searching among {request.evaluations} motions") as progress:
        found = excite(robot, request, regressors, progress)
    files = save(found, folder, {REPORT: report(found)})
    print(_summary(found))
    print(f"files            {', '.join(files)} in {folder}/")


def _summary(found: Excitation) -> str:
    solution, request = found.expected, found.request
    lines = [f"{found.robot.name}: {found.duration:g} s at {request.rate:g} Hz, {len(found.units)} base parameters"]
    if abs(request.lowest / request.frequency - 1) > _SAME:
        lines.append(f"note: {request.lowest:.6g} Hz for {request.frequency:g}: a period is a whole number of samples")
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
