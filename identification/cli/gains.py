"""Identify the drive gains of all motors by total least squares, from runs without and with a known payload.

Runs hold motor currents (columns i1 .. in) and are as in `counterpoise identify`. The known values of the payload, its
mass or first moments at least, are in the sidecars of the loaded runs or in --payload. A gain that the runs cannot
show is refused by name.

DIR receives results.json, report.html and the robot file with the gains and the parameters in it.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from generator.cli.shared_arguments import takes_out, takes_robot
from generator.command_line import command_line
from generator.errors import InputError
from generator.progress import stage
from generator.resources import find_robot
from generator.words import plural
from identification.cli.shared_arguments import takes_recipe
from identification.extras import needing

if TYPE_CHECKING:
    from identification.drive_gains import DriveGains


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT, --empty, --loaded, --payload, --out, the filters."""
    takes_robot(parser)
    parser.add_argument("--empty", metavar="RUN", nargs="+", required=True, help="runs without the payload")
    parser.add_argument("--loaded", metavar="RUN", nargs="+", required=True, help="runs with the payload")
    parser.add_argument(
        "--payload",
        metavar="NAME=VALUE",
        nargs="+",
        help="known values of the payload, such as M=175 [kg, kg m, kg m2]",
    )
    parser.add_argument(
        "--payload-std",
        metavar="NAME=VALUE",
        nargs="+",
        default=[],
        help="standard deviations of these values, such as M=0.1 [kg, kg m, kg m2]",
    )
    takes_recipe(parser)
    takes_out(parser, "where the files go (default: identified/ROBOT_gains)")


def run(arguments: argparse.Namespace) -> None:
    """Identifies, writes the results, prints a summary."""
    from generator.robot.readers import read

    with needing(command_line("counterpoise gains")):
        from identification import recipes
        from identification.destination import destination
        from identification.drive_gains import drive_gains
        from identification.gains_results import save
        from identification.observation import Regressors
        from identification.report.gains.report import report
        from identification.report.page import REPORT
        from identification.sidecar import given

    path = find_robot(arguments.robot)
    payload = None if arguments.payload is None else given(arguments.payload, command_line("--payload"))
    place = command_line("--payload-std")
    stds = given(arguments.payload_std, place).known
    for word in arguments.payload_std:
        if word.startswith("name="):
            raise InputError(place, f"payload value {word!r}", "NAME=VALUE of a known value")
    for stem, std in stds.items():
        if std < 0:
            raise InputError(place, f"{stem}={std:g}", "a number that is not negative")
    recipe = None if arguments.recipe is None else recipes.read(arguments.recipe)
    with stage(f"deriving the model of {path.stem}"):
        robot = read(path)
        runs = [*arguments.empty, *arguments.loaded]
        folder = destination(arguments.out, f"{robot.name}_gains", robot, (path, arguments.recipe), runs)
        regressors = Regressors(robot)
    with stage(f"identifying the drive gains from {plural(len(runs), 'run')}"):
        found = drive_gains(robot, arguments.empty, arguments.loaded, payload, stds, recipe, regressors)
    files = save(found, path, folder, {REPORT: report(found)})
    print(_summary(found))
    print(f"files            {', '.join(files)} in {folder}/")


def _summary(found: DriveGains) -> str:
    from identification import outcome
    from identification.gains_results import gains, parameters, refusals

    lines = [f"{found.robot.name}: {len(found.constants)} of {len(found.robot.moving)} drive gains"]
    lines += [f"note: {note}" for note in (*found.notes, *refusals(found))]
    lines += outcome.table({**gains(found), **parameters(found)})
    lines.append(f"second smallest singular value over the smallest: {found.separation:.4g}")
    each, total = found.residuals.by_joint(), found.residuals.total
    lines.append(f"||e||/||Y|| {total.relative:.4f} %, ||e||/||Y - mean|| {total.relative_to_mean:.2f} % ({each})")
    return "\n".join(lines)
