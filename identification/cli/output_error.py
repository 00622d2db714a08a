"""Identify the dynamic parameters of a robot by output error: simulated in open loop, its positions follow the runs.

Runs are as in `counterpoise identify`, whose estimate from them is the first start. The simulation restarts in each
segment, at a state that is estimated too. DIR receives results.json, report.html, the robot file with the parameters in
it, and the result of each start when it is done: after an interruption, the same command continues.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from generator.bounds import above, whole_number
from generator.cli.shared_arguments import takes_out, takes_robot
from generator.command_line import command_line
from generator.errors import InputError
from generator.progress import counter, stage
from generator.resources import find_robot
from generator.words import plural
from identification import executors
from identification.cli.shared_arguments import takes_data, takes_recipe, takes_test
from identification.extras import needing

if TYPE_CHECKING:
    from generator.robot.description import Robot
    from identification.output_error.search import Settings


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT, --data, --test, --out, the search, the starts, where they run."""
    takes_robot(parser)
    takes_data(parser)
    takes_test(parser)
    takes_out(parser, "where the files go (default: identified/ROBOT_output_error)")
    _search(parser.add_argument_group("search"))
    _starts(parser.add_argument_group("starts"))


def _search(group: argparse._ActionsContainer) -> None:
    group.add_argument(
        "--method",
        metavar="NAME",
        default="gauss-newton",
        help="gauss-newton, nelder-mead or evolution (default: gauss-newton)",
    )
    group.add_argument(
        "--filtered", action="store_true", help="torques pass the recipe's filter, as in section 6.2 of the deliverable"
    )
    group.add_argument("--segment", metavar="S", default="1", help="time of one simulation, or none (default: 1)")
    group.add_argument("--iterations", metavar="N", type=int, help="largest number of iterations of each start")
    group.add_argument("--seconds", metavar="S", type=float, help="longest time of each start")
    group.add_argument(
        "--margin",
        metavar="KGM2",
        type=float,
        help="smallest allowed eigenvalue of M(q) [kg m2, kg] (default: a tenth of the start's)",
    )
    group.add_argument("--fix", metavar="NAME=VALUE", nargs="+", default=[], help="given parameters")
    takes_recipe(group)


def _starts(group: argparse._ActionsContainer) -> None:
    group.add_argument(
        "--starts",
        metavar="N",
        type=int,
        default=1,
        help="number of starts; the first is the inverse model's estimate (default: 1)",
    )
    group.add_argument(
        "--spread",
        metavar="K",
        type=float,
        default=2.0,
        help="spread of the other starts, in standard deviations of the first (default: 2)",
    )
    group.add_argument("--seed", metavar="N", type=int, default=0, help="seed of the other starts (default: 0)")
    executors.configure(group)


def run(arguments: argparse.Namespace) -> None:
    """Identifies, writes the results, prints a summary."""
    from generator.robot.readers import read

    with needing(command_line("counterpoise output-error")):
        from identification.destination import destination
        from identification.output_error.multi_start import output_error
        from identification.output_error.results import save, summary
        from identification.report.output_error.report import report
        from identification.report.page import REPORT

    path = find_robot(arguments.robot)
    robot = read(path)
    runs = [*arguments.data, *arguments.test]
    folder = destination(arguments.out, f"{robot.name}_output_error", robot, (path, arguments.recipe), runs)
    with stage(f"deriving the model of {robot.name}"):
        settings = _settings(arguments, robot)
    with executors.opened(arguments) as executor, counter("starts") as counted:
        found = output_error(
            robot,
            arguments.data,
            arguments.test,
            settings,
            count=arguments.starts,
            executor=executor,
            folder=folder,
            counted=counted,
        )
    files = save(found, path, folder, {REPORT: report(found)})
    print(f"{robot.name}: {plural(len(found.best.names), 'parameter')} by output error")
    print("\n".join(summary(found)))
    print(f"files            {', '.join(files)} in {folder}/")


def _settings(arguments: argparse.Namespace, robot: Robot) -> Settings:
    from generator.derivation import derive
    from generator.robot.fields import nearest
    from identification import recipes
    from identification.fixing import fixed
    from identification.output_error.methods import methods
    from identification.output_error.search import Settings

    if arguments.method not in methods():
        raise InputError(
            command_line("--method"), f"there is no method {arguments.method!r}", nearest(arguments.method, methods())
        )
    for name, least in (("iterations", 1), ("starts", 1), ("seed", 0)):
        value = getattr(arguments, name)
        if value is not None:
            whole_number(value, f"--{name}", least)
    for name in ("seconds", "spread", "margin"):
        value = getattr(arguments, name)
        if value is not None:
            above(value, f"--{name}", 0)
    recipe = recipes.recipe_of(robot.name, arguments.recipe)
    given = {}
    if arguments.fix:
        given = fixed(arguments.fix, None, derive(robot, names=("regressor_packed",)), command_line("--fix"))
    return Settings(
        recipe=recipe,
        segment=_segment(arguments.segment),
        filtered=arguments.filtered,
        method=arguments.method,
        iterations=arguments.iterations,
        seconds=arguments.seconds,
        margin=arguments.margin,
        fixed=given,
        spread=arguments.spread,
        seed=arguments.seed,
    )


def _segment(text: str) -> float | None:
    if text == "none":
        return None
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0 < value < float("inf"):
        raise InputError(command_line("--segment"), repr(text), "a time in s, or none")
    return value
