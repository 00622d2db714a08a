"""Identify the stiffness of drive trains: output blocked, steps of force on a rigid stop, or link-side encoders.

--locked J takes runs in which the output of joint J is blocked. --pressed takes runs, one per pose, in which the tool
presses on a rigid stop. They hold any of the columns fx fy fz mx my mz, the wrench in the tool frame; if they also hold
currents, torque constants are identified too. --link-encoders takes runs of a moving robot with columns qs; their
latency is found and removed first. Values that the runs cannot show are refused by name. DIR receives results.json,
report.html and the robot file with the values in it.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from generator.cli.shared_arguments import takes_out, takes_robot
from generator.command_line import command_line
from generator.progress import stage
from generator.resources import find_robot
from generator.words import plural
from identification.cli.shared_arguments import takes_data, takes_recipe
from identification.extras import needing

if TYPE_CHECKING:
    from generator.robot.description import Robot
    from identification.stiffness_results import Found


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT, --data, --locked, --pressed or --link-encoders, --prior, --recipe, --out."""
    takes_robot(parser)
    takes_data(parser)
    how = parser.add_mutually_exclusive_group(required=True)
    how.add_argument("--locked", metavar="J", type=int, help="the output of joint J is blocked")
    how.add_argument("--pressed", action="store_true", help="the tool presses on a rigid stop")
    how.add_argument("--link-encoders", action="store_true", help="the robot moves, and its links have encoders qs")
    parser.add_argument(
        "--prior",
        metavar="SET",
        help="parameter set of the robot with known balancers, inertias of rotors or viscous friction",
    )
    takes_recipe(parser)
    takes_out(parser, "where the files go (default: identified/ROBOT_stiffness)")


def run(arguments: argparse.Namespace) -> None:
    """Identifies, writes the results, prints a summary."""
    from generator.robot.readers import read

    with needing(command_line("counterpoise stiffness")):
        from identification.destination import destination
        from identification.report.page import REPORT
        from identification.report.stiffness.report import report
        from identification.stiffness_results import save

    path = find_robot(arguments.robot)
    robot = read(path)
    folder = destination(arguments.out, f"{robot.name}_stiffness", robot, (path, arguments.recipe), arguments.data)
    found = _identified(arguments, robot)
    files = save(found, path, folder, {REPORT: report(found)})
    print(_summary(found))
    print(f"files            {', '.join(files)} in {folder}/")


def _identified(arguments: argparse.Namespace, robot: Robot) -> Found:
    from identification import force_steps, link_encoders, locked_output, recipes

    data, prior = arguments.data, {} if arguments.prior is None else _prior(arguments.prior, robot)
    recipe = None if arguments.recipe is None else recipes.read(arguments.recipe)
    with stage(f"identifying stiffness from {plural(len(data), 'run')}"):
        if arguments.pressed:
            return force_steps.force_steps(robot, data, prior, recipe or force_steps.RECIPE)
        if arguments.link_encoders:
            return link_encoders.link_encoders(robot, data, prior, recipe or link_encoders.RECIPE)
        return locked_output.locked_output(robot, arguments.locked, data, prior, recipe or locked_output.RECIPE)


def _summary(found: Found) -> str:
    from identification.outcome import table
    from identification.stiffness_results import document

    results = document(found)
    total = results["residual"]["train"]["total"]
    lines = [f"{found.robot.name}: {results['method']['name']}", *(f"note: {note}" for note in results["notes"])]
    lines += table(found.values)
    lines.append(f"||e||/||Y|| {total['relative_percent']:.4f} %")
    return "\n".join(lines)


def _prior(name: str, robot: Robot) -> dict[str, float]:
    from identification.named_set import named_set

    return {one: value.value for one, value in named_set(robot, name, command_line("--prior")).values.items()}
