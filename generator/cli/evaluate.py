"""Evaluate a quantity of a robot at one state and print JSON: {output: nested lists}.

Every input of the quantity is an option, its numbers separated by spaces or commas:
  counterpoise evaluate ROBOT gravity --q 0 -pi/4 0.2 0 0 0 --parameters SET
  counterpoise evaluate ROBOT inverse_dynamics --help     lists the inputs with their sizes and units

--parameters is a set of the robot file, or a JSON or YAML file {name: value} with base or standard parameters.
Parameters that a set lacks are zero (not essential); lengths and torque constants are those of the robot file unless
the set has them. A wrench, payload, states or warmth that is not given is zero.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from generator.cli.shared_arguments import takes_robot
from generator.command_line import command_line
from generator.errors import InputError
from generator.resources import find_robot

if TYPE_CHECKING:
    from generator.symbolic.function import Function
    from generator.symbolic.model import Model
    from generator.symbolic.parameter_sets import Values, Vector

_COMMAND = "counterpoise evaluate"


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT QUANTITY and the options of the quantity's inputs."""
    parser.usage = "counterpoise evaluate ROBOT QUANTITY [--SIGNAL NUMBER ...] [--parameters SET]"
    takes_robot(parser)
    parser.add_argument("quantity", metavar="QUANTITY", help="inverse_dynamics, regressor, inertia_matrix, ...")
    options = parser.add_argument("options", nargs=argparse.REMAINDER, help=argparse.SUPPRESS)
    options.required = False


def run(arguments: argparse.Namespace) -> None:
    """Prints one JSON object on one line."""
    from generator.cli import signal_options

    words = ["--help" if word == "-h" else word for word in arguments.options]
    given = signal_options.split(words, _COMMAND)
    model, function = _derived(arguments.robot, arguments.quantity)
    if "help" in given:
        print(_signature(function))
        return
    _check_known(function, given)
    print(json.dumps(_outputs(model, function, given), allow_nan=False))


def _derived(robot: str, name: str) -> tuple[Model, Function]:
    """The model with this one function."""
    from generator.derivation import derive, quantities
    from generator.robot.fields import nearest
    from generator.robot.readers import read

    model = derive(read(find_robot(robot)), names=(name,), check=False, plain=True)
    if name not in model.functions:
        known = [quantity.name for quantity in quantities().values() if quantity.applies(model)]
        why = quantities()[name].absence(model) if name in quantities() else ""
        problem = f"{model.robot.name} has no quantity {name!r}" + (f": {why}" if why else "")
        raise InputError(command_line(_COMMAND), problem, nearest(name, known))
    return model, model.functions[name]


def _check_known(function: Function, given: dict[str, str]) -> None:
    from generator.robot.fields import nearest
    from generator.symbolic.model import STANDARD

    known = [signal.name for signal in function.inputs if signal.name != STANDARD] + ["parameters"]
    for name in given:
        if name not in known:
            raise InputError(
                command_line(f"{_COMMAND} --{name}"), f"{function.name} has no such input", nearest(name, known)
            )


def _outputs(model: Model, function: Function, given: dict[str, str]) -> dict[str, object]:
    """The function's outputs by name, as nested lists."""
    import numpy as np

    from generator.cli import signal_options
    from generator.symbolic.function import PARAMETERS
    from generator.symbolic.interpret import evaluate
    from generator.symbolic.model import STANDARD
    from generator.symbolic.parameter_sets import impossible, parameter_vector, regrouped, standard_vector

    values = _values(model, function, given.get("parameters"))
    inputs: dict[str, Vector] = {PARAMETERS: parameter_vector(model, values)}
    if given.get("parameters") not in (None, *model.robot.parameter_sets):
        for note in impossible(model, regrouped(model, values)):
            print(note, file=sys.stderr)
    for signal in function.inputs:
        if signal.name == STANDARD:
            inputs[STANDARD] = standard_vector(model, values)
        else:
            inputs[signal.name] = signal_options.value(signal, given, _COMMAND)
    with np.errstate(all="ignore"):
        outputs = evaluate(function, inputs)
    for name, array in outputs.items():
        if not np.isfinite(array).all():
            raise InputError(command_line(_COMMAND), f"{name} is not finite here", "a state and parameters where it is")
    return {name: (array + 0.0).tolist() for name, array in outputs.items()}  # + 0.0 turns -0.0 into 0.0


def _values(model: Model, function: Function, chosen: str | None) -> Values:
    """The values of the set or file that --parameters names; none where the function needs none."""
    from generator.robot import parameter_file
    from generator.symbolic.model import STANDARD

    sets = model.robot.parameter_sets
    place = command_line(f"{_COMMAND} --parameters")
    choice = f"{', '.join(sets)} or the path of a JSON or YAML file" if sets else "the path of a JSON or YAML file"
    if chosen is None:
        if not _needs_identified(model, function) and all(signal.name != STANDARD for signal in function.inputs):
            return {}
        raise InputError(command_line(_COMMAND), "--parameters is missing", choice)
    if chosen in sets:
        return sets[chosen].values
    if not os.path.exists(chosen):
        raise InputError(place, f"there is no parameter set and no file {chosen!r}", choice)
    return parameter_file.read(Path(chosen))


def _needs_identified(model: Model, function: Function) -> bool:
    """Whether the function reads parameters that the robot's description does not itself give a value."""
    given = {parameter.name for parameter in (*model.torque_constants, *model.symbolic_lengths)}
    nodes = {node for name, node in model.parameter_nodes.items() if name not in given}
    return not nodes.isdisjoint(function.nodes)


def _signature(function: Function) -> str:
    from generator.cli.signal_options import describe

    lines = [f"{function.name}: {function.summary}", function.details]
    lines += [f"  --{signal.name}: {describe(signal)}" for signal in function.inputs]
    lines += [
        f"  prints {output.signal.name} {list(output.signal.shape)}: {output.signal.meaning}"
        for output in function.outputs
    ]
    return "\n".join(line for line in lines if line.strip())
