"""How recorded signals differ from what the model means: corrections that no generated function holds."""

from __future__ import annotations

import sympy

from generator.review.decimals import constant, decimal
from generator.review.markup import Content, Markup, element, join, table
from generator.review.words import minus, unit
from generator.robot.description import Joint
from generator.symbolic.model import Model

TITLE = "Signals"
ORDER = 105

#: What is written above a column, and its unit where that is the same on all joints.
_COLUMNS = {
    "position_offset": ("added to recorded positions", ""),
    "torque_gain": ("motor torque over the recorded one", ""),
    "torque_delay": ("torque recorded late by", "s"),
    "link_delay": ("link position recorded late by", "s"),
    "current_limit": ("current saturates at", "A"),
    "warm_up_time": ("drive warms up with time constant", "s"),
    "warm_rise": ("drive is warm after a rise of", "K"),
    "warm_torque": ("drive is warm under an rms motor torque of", ""),
}


def render(model: Model) -> Markup | None:
    given = {name: values for name, values in vars(model.robot.signals).items() if values}
    if not given:
        return None
    heads: list[Content] = ["joint", *(_COLUMNS[name][0] for name in given)]
    rows = [
        [
            str(joint.number),
            *(_shown(values[k], _unit(name, joint, model.robot.drives is not None)) for name, values in given.items()),
        ]
        for k, joint in enumerate(model.robot.moving)
    ]
    note = "For recorded motion; the generated functions take true positions, torques and currents."
    return join(element("p", note), table(heads, rows, class_="numbers"))


def _unit(name: str, joint: Joint, driven: bool) -> str:
    if name == "warm_torque":
        return joint.motor_unit(driven)
    return joint.position_unit if name == "position_offset" else _COLUMNS[name][1]


def _shown(value: sympy.Expr, symbol: str) -> str:
    number = minus(decimal(constant(value)))
    return f"{number}\u00a0{unit(symbol)}" if symbol else number
