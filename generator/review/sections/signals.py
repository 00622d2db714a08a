"""How recorded signals differ from what the model means: corrections that no generated function holds."""

from __future__ import annotations

import sympy

from generator.review.decimals import constant, decimal
from generator.review.markup import Content, Markup, element, join, table
from generator.review.words import minus, unit
from generator.robot.description import PRISMATIC
from generator.symbolic.model import Model

TITLE = "Signals"
ORDER = 105

#: What is written above a column, and its unit on a revolute joint.
_COLUMNS = {
    "position_offset": ("added to recorded positions", "rad"),
    "torque_gain": ("motor torque over the recorded one", ""),
    "torque_delay": ("torque recorded late by", "s"),
    "link_delay": ("link position recorded late by", "s"),
    "current_limit": ("current saturates at", "A"),
    "warm_up_time": ("drive warms up with time constant", "s"),
    "warm_rise": ("drive is warm after a rise of", "K"),
    "warm_torque": ("drive is warm under an rms motor torque of", "N m"),
}


def render(model: Model) -> Markup | None:
    given = {name: values for name, values in vars(model.robot.signals).items() if values}
    if not given:
        return None
    heads: list[Content] = ["joint", *(_COLUMNS[name][0] for name in given)]
    rows = [
        [
            str(joint.number),
            *(_shown(values[k], name, joint.sigma == PRISMATIC) for name, values in given.items()),
        ]
        for k, joint in enumerate(model.robot.moving)
    ]
    note = "For recorded motion; the generated functions take true positions, torques and currents."
    return join(element("p", note), table(heads, rows, class_="numbers"))


def _shown(value: sympy.Expr, name: str, prismatic: bool) -> str:
    symbol = _COLUMNS[name][1]
    symbol = "m" if symbol == "rad" and prismatic else symbol
    number = minus(decimal(constant(value)))
    return f"{number}\u00a0{unit(symbol)}" if symbol else number
