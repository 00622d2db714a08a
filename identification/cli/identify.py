"""Identify the dynamic parameters of a robot from recorded runs, by the inverse dynamic model and least squares.

A run is a file with columns t, q1 .. qn (or qm1 .. qmn on the motors) and tau1 .. taun (or taum1 .. taumn, or currents
i1 .. in); FILE@FROM:TO takes a part of it, with times in s. Filters come from the robot's recipe in recipes/, or from
--recipe, or from the options. DIR receives results.json, report.html and the robot file with the identified parameters
in it.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from generator.bounds import above, not_negative, whole_number
from generator.cli.shared_arguments import takes_out, takes_robot
from generator.command_line import command_line
from generator.progress import stage
from generator.resources import find_robot
from generator.words import listed, plural
from identification.cli.shared_arguments import takes_data, takes_test
from identification.extras import needing

if TYPE_CHECKING:
    from generator.symbolic.model import Model
    from identification.consistent_fit import ConsistentFit
    from identification.inverse_model import Identification, Options
    from identification.observation import Regressors
    from identification.recipes import Recipe
    from identification.sensitivity import Variation

#: Largest weight of a prior: beyond, nothing of the runs is left beside it.
_HEAVIEST = 1e12


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT, --data, --test, --out, the filters, the method."""
    takes_robot(parser)
    takes_data(parser)
    takes_test(parser)
    takes_out(parser, "where the files go (default: identified/ROBOT)")
    _filters(parser.add_argument_group("filters"))
    _method(parser.add_argument_group("method"))


def _filters(group: argparse._ActionsContainer) -> None:
    group.add_argument("--recipe", metavar="FILE", type=Path, help="a YAML file with the settings below")
    group.add_argument(
        "--dynamics",
        metavar="HZ",
        type=float,
        help="highest frequency of the motion's dynamics (default: the recipe's, else 2)",
    )
    group.add_argument(
        "--cutoff",
        metavar="HZ",
        type=float,
        help="cut-off of the Butterworth filter (default: the recipe's, else 5 times --dynamics)",
    )
    group.add_argument(
        "--order", metavar="N", type=int, help="order of the Butterworth filter (default: the recipe's, else 4)"
    )
    group.add_argument(
        "--factor",
        metavar="N",
        type=int,
        help="factor of the decimation (default: the recipe's, else to 5 times --dynamics)",
    )
    group.add_argument(
        "--standstill",
        metavar="SPEED",
        type=float,
        help="speed below which a joint's rows are left out [rad/s, m/s] (default: the recipe's, else 0.03, 0.005)",
    )
    group.add_argument("--sensitivity", action="store_true", help="also try half and twice the cut-off and the factor")


def _method(group: argparse._ActionsContainer) -> None:
    group.add_argument(
        "--weights", choices=("joint", "none"), help="weights by joint, or none (default: the recipe's, else joint)"
    )
    group.add_argument("--robust", action="store_true", help="Huber's weights against outliers")
    group.add_argument("--bootstrap", metavar="N", type=int, help="standard deviations by a block bootstrap of N draws")
    group.add_argument(
        "--essential",
        metavar="RATIO",
        type=float,
        help="largest allowed ratio of relative standard deviations; ignores the residual's growth",
    )
    group.add_argument(
        "--fix", metavar="NAME[=VALUE]", nargs="+", default=[], help="given parameters, such as Fv* or bodies"
    )
    group.add_argument(
        "--prior", metavar="SET", help="parameter set of the robot: values for --fix, bodies for --consistent"
    )
    group.add_argument(
        "--consistent",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="also estimate physically consistent parameters, near the bodies of --prior if it tells all their masses",
    )
    group.add_argument(
        "--prior-weight", metavar="W", type=float, default=0.03, help="weight of these bodies (default: 0.03)"
    )
    group.add_argument(
        "--payload",
        metavar="NAME=VALUE",
        nargs="*",
        help="runs carry a payload with these known values, such as M=150 [kg, kg m, kg m2]",
    )


def run(arguments: argparse.Namespace) -> None:
    """Identifies, writes the results, prints a summary."""
    from generator.robot.readers import read

    with needing(command_line("counterpoise identify")):
        from identification.destination import destination
        from identification.inverse_model import identify
        from identification.observation import Regressors
        from identification.report.identify.report import report
        from identification.report.page import REPORT
        from identification.results import older_sets, save
        from identification.sensitivity import sensitivity

    path = find_robot(arguments.robot)
    with stage(f"deriving the model of {path.stem}"):
        robot = read(path)
        runs = [*arguments.data, *arguments.test]
        folder = destination(arguments.out, robot.name, robot, (path, arguments.recipe), runs)
        regressors = Regressors(robot)
    options = _options(arguments, regressors)
    weight = above(arguments.prior_weight, "--prior-weight", 0, _HEAVIEST)
    with stage(f"identifying from {plural(len(arguments.data), 'run')}"):
        found = identify(robot, arguments.data, arguments.test, options, regressors)
    found, consistent = _consistent(arguments, found, weight) if arguments.consistent else (found, None)
    found = found.noting(older_sets(found, consistent))
    variations: list[Variation] = []
    if arguments.sensitivity:
        with stage("trying other filters"):
            variations, untried = sensitivity(found, arguments.data)
        found = found.noting(untried)
    with stage("writing the report"):
        page = {REPORT: report(found, consistent, variations)}
    files = save(found, path, folder, consistent, variations, page)
    print(_summary(found, consistent))
    for one in variations:
        print(f"{one.setting} {one.value:g}: no parameter moves by more than {one.change:.2f} std ({one.parameter})")
    print(f"files            {', '.join(files)} in {folder}/")


def _options(arguments: argparse.Namespace, regressors: Regressors) -> Options:
    from identification.fixing import fixed
    from identification.inverse_model import Options
    from identification.named_set import named_set
    from identification.sidecar import given

    model, prior = regressors.model, None
    if arguments.prior is not None:
        prior = named_set(model.robot, arguments.prior, command_line("--prior"))
    ratio = (
        {}
        if arguments.essential is None
        else {"ratio": above(arguments.essential, "--essential", 1), "growth": float("inf")}
    )
    return Options(
        recipe=_recipe(arguments, regressors),
        fixed=fixed(arguments.fix, prior, model, command_line("--fix"), "--prior SET"),
        robust=arguments.robust,
        draws=0 if arguments.bootstrap is None else whole_number(arguments.bootstrap, "--bootstrap", 50, 100_000),
        payload=None if arguments.payload is None else given(arguments.payload, command_line("--payload")),
        **ratio,
    )


def _consistent(
    arguments: argparse.Namespace, found: Identification, weight: float
) -> tuple[Identification, ConsistentFit | None]:
    """The physically consistent parameters beside what was found, which tells why where there are none."""
    from identification.consistent_fit import consistent_fit, doubts

    bodies, notes = (None, []) if arguments.prior is None else _bodies(arguments.prior, found.regressors.model)
    found = found.noting(notes)
    with stage("making the parameters physically consistent"):
        try:
            consistent = consistent_fit(found, bodies, weight)
        except ValueError as error:
            return found.noting([str(error)]), None
        return found.noting(doubts(found, consistent)), consistent


def _bodies(name: str, model: Model) -> tuple[dict[str, float] | None, list[str]]:
    """The standard parameters of a set that gives the bodies, those that it lacks zero; None for any other, and a note
    where only masses lack.
    """
    from generator.robot.parameters import inertial_parameters

    bodies = model.robot.bodies
    values = {one: value.value for one, value in model.robot.parameter_sets[name].values.items()}
    inertial = [one.name for joint in bodies for one in inertial_parameters(joint)]
    massless = [one for one in (f"M{joint.number}" for joint in bodies) if one not in values]
    if not massless:
        return dict.fromkeys(inertial, 0.0) | values, []
    of_bodies = set(inertial) - {one.name for one in model.base_parameters}
    told = f"the set {name} does not tell {listed(massless)}: no parameters were kept near its bodies"
    return None, [told] if of_bodies & values.keys() else []


def _recipe(arguments: argparse.Namespace, regressors: Regressors) -> Recipe:
    from identification import recipes

    robot = regressors.model.robot.name
    base = recipes.recipe_of(robot, arguments.recipe)
    for name in ("dynamics", "cutoff"):
        if getattr(arguments, name) is not None:
            above(getattr(arguments, name), f"--{name}", 0)
    for name in ("order", "factor"):
        if getattr(arguments, name) is not None:
            whole_number(getattr(arguments, name), f"--{name}", 1)
    for name in ("dynamics", "cutoff", "order"):
        if getattr(arguments, name) is not None:
            recipes.check_filter(name, getattr(arguments, name), command_line(f"--{name}"))
    if arguments.factor is not None:
        recipes.check_stages(arguments.factor, command_line("--factor"))
    if arguments.standstill is not None:
        not_negative(arguments.standstill, "--standstill")
    names = ("dynamics", "cutoff", "order", "factor", "standstill", "weights")
    return base.changed(**{name: getattr(arguments, name) for name in names})


def _units(found: Identification) -> dict[str, str]:
    """Those of all parameters by name, of payloads too."""
    from identification.sidecar import UNITS

    payloads = [payload for one in found.train if (payload := one.sampled.run.payload) is not None]
    own = {name: UNITS[stem] for one in payloads for stem, name in one.names().items()}
    return found.units | own


def _summary(found: Identification, consistent: ConsistentFit | None) -> str:
    lines = [
        f"{found.robot.name}: {plural(len(found.full.sought), 'parameter')}, "
        f"{len(found.essential_names)} of them essential"
    ]
    lines += [f"note: {note}" for note in found.notes]
    solution = found.full.solution
    names = [name for name in solution.values if name in found.full.sought or name in found.options.fixed]
    units = _units(found)
    width = max(map(len, [*names, "parameter"]))
    lines.append(f"{'parameter'.ljust(width)} {'value':>12} {'std':>10} {'std %':>9}  essential  unit")
    for name in names:
        hidden = name in solution.hidden
        value = "unknown" if hidden else f"{solution.values[name]:.7g}"
        mark = "fixed" if name not in found.full.sought else "yes" if name in found.essential_names else "no"
        lines.append(
            f"{name.ljust(width)} {value:>12} {solution.std(name):>10.4g} {solution.relative_std(name):>9.4g}  "
            f"{mark:<9}  {units[name]}"
        )
    lines.append(
        f"condition of W   {solution.condition:.7g}, with columns of unit length {solution.scaled_condition:.6g}"
    )
    for title, estimate in (
        ("all parameters", found.full),
        ("essential ones", found.essential),
        ("consistent ones", consistent),
    ):
        if estimate is None:
            continue
        for kind, result in (("train", estimate.train), ("test", estimate.test)):
            if result is None:
                continue
            each, total = result.by_joint(), result.total
            lines.append(
                f"{title}, {kind}: ||e|| {total.norm:.7g}, ||e||/||Y|| {total.relative:.4f} %, "
                f"||e||/||Y - mean|| {total.relative_to_mean:.2f} % ({each})"
            )
    return "\n".join(lines)
