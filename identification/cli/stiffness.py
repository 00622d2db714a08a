"""Identify the stiffness of drive trains, with the output blocked or with steps of force on a rigid stop.

--locked J takes runs in which the output of joint J is blocked. --pressed takes runs, one a pose, in which the tool
presses on a rigid stop; they hold columns fx fy fz mx my mz of the wrench in the tool frame, any of them, and where
they hold currents, torque constants are identified too. What the poses cannot show is refused by name. DIR receives
results.json, report.html and the robot file with the values in it.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from generator.cli.place import command_line
from generator.cli.progress import stage
from generator.errors import InputError
from generator.resources import find_robot

if TYPE_CHECKING:
    from generator.robot.description import Robot


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT, --data, --locked or --pressed, --prior, --recipe, --out."""
    parser.add_argument("robot", metavar="ROBOT", help="a name in robots/ or the path of a robot file")
    parser.add_argument("--data", metavar="RUN", nargs="+", required=True, help="runs to identify from")
    how = parser.add_mutually_exclusive_group(required=True)
    how.add_argument("--locked", metavar="J", type=int, help="the output of joint J is blocked")
    how.add_argument("--pressed", action="store_true", help="the tool presses on a rigid stop")
    parser.add_argument(
        "--prior", metavar="SET", help="parameter set of the robot with its balancer, or with its rotors' inertias"
    )
    parser.add_argument("--recipe", metavar="FILE", type=Path, help="a YAML file with the filters' settings")
    parser.add_argument("--out", metavar="DIR", type=Path, help="default: identified/ROBOT_stiffness")


def run(arguments: argparse.Namespace) -> None:
    """Identifies, writes the results, prints a summary."""
    from generator.robot.readers import read

    try:
        from identification import force_steps, locked_output, outcome, stiffness_results
        from identification.recipe import read as recipe_of
        from identification.report.page import REPORT
        from identification.report.stiffness.report import report
    except ModuleNotFoundError as error:
        extra = "pip install 'counterpoise[identification]'"
        raise InputError(command_line("counterpoise stiffness"), f"{error.name} is not installed", extra) from None

    path = find_robot(arguments.robot)
    robot = read(path)
    prior = {} if arguments.prior is None else _prior(arguments.prior, robot)
    own = force_steps.RECIPE if arguments.pressed else locked_output.RECIPE
    recipe = own if arguments.recipe is None else recipe_of(arguments.recipe)
    with stage(f"identifying stiffness from {len(arguments.data)} runs"):
        if arguments.pressed:
            steps = force_steps.force_steps(robot, arguments.data, prior, recipe)
            values, document = {**steps.stiffness, **steps.constants}, stiffness_results.of_steps(steps)
            page = report(steps, document)
        else:
            locked = locked_output.locked_output(robot, arguments.locked, arguments.data, prior, recipe)
            values, document = dict(locked.essential), stiffness_results.of_locked(locked)
            page = report(locked, document)
    folder = arguments.out or Path("identified") / f"{robot.name}_stiffness"
    files = stiffness_results.save(document, values, robot, path, folder, {REPORT: page})
    total = document["residual"]["train"]["total"]
    lines = [f"{robot.name}: {document['method']['name']}", *(f"note: {note}" for note in document["notes"])]
    lines += outcome.table(values)
    lines.append(f"||e||/||Y|| {total['relative_percent']:.4f} %")
    print("\n".join(lines))
    print(f"files            {', '.join(files)} in {folder}/")


def _prior(name: str, robot: Robot) -> dict[str, float]:
    from generator.robot.fields import nearest

    if name not in robot.parameter_sets:
        problem = f"{robot.name} has no parameter set {name!r}"
        raise InputError(command_line("--prior"), problem, nearest(name, robot.parameter_sets))
    return {one: value.value for one, value in robot.parameter_sets[name].values.items()}
