"""What the robot file states beside its geometry, in plain rows: effects and their values, drives, signals, gravity."""

from __future__ import annotations

import sympy

from generator.constants import exact_constant
from generator.effects.library import Instance, unit_of
from generator.review.decimals import MACHINE, decimal, rounded, scientific
from generator.robot.description import Drives, Robot
from generator.robot.parameters import Parameter
from generator.robot.signal_units import signal_unit
from generator.symbolic.model import Model
from generator.words import numbered, ranges

#: Rows of a table, its head first; empty where the file states nothing of it.
Table = tuple[tuple[str, ...], ...]


def gravity(robot: Robot) -> str:
    """The acceleration of free fall [m/s2] in the world frame."""
    return ", ".join(number(component) for component in robot.gravity)


def base(robot: Robot) -> tuple[str, ...]:
    """The rows of the pose of frame 0 in the world frame, lengths in m; none where the two are one."""
    if robot.base == sympy.eye(4):
        return ()
    return tuple(" ".join(number(entry) for entry in robot.base.row(i)) for i in range(4))


def effects(model: Model) -> Table:
    """Each effect, the joints that have it with the same values, and those values with their units."""
    joints: dict[tuple[str, str], list[int]] = {}
    shaped = [one for one in model.motor_effects if one.site.values != {s.name: s.default for s in one.effect.shapes}]
    for instance in (*model.effects, *shaped):
        joints.setdefault((instance.effect.id, values(instance, model.robot)), []).append(instance.joint.number)
    rows = tuple((effect, ", ".join(ranges(sorted(set(numbers)))), told) for (effect, told), numbers in joints.items())
    return (("effect", "joints", "values"), *rows) if rows else ()


def elastic(model: Model) -> str:
    """The joints whose drive train is elastic; empty where none is."""
    return numbered("joint", [model.robot.moving[k].number for k in model.elastic]) if model.elastic else ""


def values(instance: Instance, robot: Robot) -> str:
    """``d21 = 0.9669 m, exponent = 1``: the shape values of an effect on a joint; "none" where it has none."""
    given = instance.site.values
    return (
        ", ".join(
            f"{shape.name} = {quantity(given[shape.name], unit_of(shape, instance, robot))}"
            for shape in instance.effect.shapes
        )
        or "none"
    )


def drives(robot: Robot) -> Table:
    """Gear ratios, the matrix N row by row, torque constants and their drift, one motor a row."""
    if robot.drives is None:
        return ()
    stated = robot.drives
    heads = ["joint", "gear ratio", "row of N"]
    heads += torque_constant_heads(stated)
    heads += ["drift at warmth 1"] if stated.torque_drift else []
    rows = []
    for k, joint in enumerate(robot.moving):
        ratio = _with_unit(str(stated.ratios[k]), joint.ratio_unit)
        row = [str(joint.number), ratio, ", ".join(map(str, stated.coupling[k]))]
        row += [decimal(constants[k]) for constants in stated.torque_constants.values()]
        row += [rounded(stated.torque_drift[k])] if stated.torque_drift else []
        rows.append(tuple(row))
    return (tuple(heads), *rows)


def torque_constant_heads(drives: Drives) -> list[str]:
    """What is written above the columns of the torque constants."""
    return [
        f"torque constant, {name}{', in use' if name == drives.torque_constant else ''} [N m/A]"
        for name in drives.torque_constants
    ]


#: What is written above a column of the signals' corrections.
_CORRECTIONS = {
    "position_offset": "added to recorded positions",
    "torque_gain": "motor torque over the recorded one",
    "torque_delay": "torque recorded late by",
    "link_delay": "link position recorded late by",
    "current_limit": "current saturates at",
    "warm_up_time": "drive warms up with time constant",
    "warm_rise": "drive is warm after a rise of",
    "warm_torque": "drive is warm under an rms motor torque of",
}


def signals(robot: Robot) -> Table:
    """How recorded signals differ from what the model means, one joint a row."""
    given = {name: listed for name, listed in vars(robot.signals).items() if listed}
    if not given:
        return ()
    driven = robot.drives is not None
    rows = (
        (
            str(joint.number),
            *(quantity(listed[k], signal_unit(name, joint, driven)) for name, listed in given.items()),
        )
        for k, joint in enumerate(robot.moving)
    )
    return (("joint", *(_CORRECTIONS[name] for name in given)), *rows)


def built_in(model: Model) -> list[tuple[Parameter, str]]:
    """The parameters whose values [SI] are numbers in the code, but for zeros, with the digits that stand there."""
    given = ((parameter, model.constants.get(parameter.name, 0)) for parameter in model.all_parameters)
    return [(parameter, scientific(value, MACHINE)) for parameter, value in given if value]


def quantity(value: sympy.Expr, symbol: str) -> str:
    """A constant with its unit, which a pure number lacks."""
    return _with_unit(number(value), symbol)


def _with_unit(text: str, symbol: str) -> str:
    return text if symbol == "1" else f"{text} {symbol}"


def number(value: sympy.Expr) -> str:
    """A constant expression in decimal notation."""
    return decimal(exact_constant(value))
