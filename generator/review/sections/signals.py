"""How recorded signals differ from what the model means: corrections that no generated function holds."""

from __future__ import annotations

import sympy

from generator.review.decimals import constant, decimal
from generator.review.markup import Content, Markup, element, join, table
from generator.review.words import minus, unit
from generator.robot.signal_units import signal_unit
from generator.symbolic.model import Model

TITLE = "Signals"
ORDER = 105

#: What is written above a column.
_HEADS = {
    "position_offset": "added to recorded positions",
    "torque_gain": "motor torque over the recorded one",
    "torque_delay": "torque recorded late by",
    "link_delay": "link position recorded late by",
    "current_limit": "current saturates at",
    "warm_up_time": "drive warms up with time constant",
    "warm_rise": "drive is warm after a rise of",
    "warm_torque": "drive is warm under an rms motor torque of",
}


def render(model: Model) -> Markup | None:
    given = {name: values for name, values in vars(model.robot.signals).items() if values}
    if not given:
        return None
    driven = model.robot.drives is not None
    heads: list[Content] = ["joint", *(_HEADS[name] for name in given)]
    rows = [
        [
            str(joint.number),
            *(_shown(values[k], signal_unit(name, joint, driven)) for name, values in given.items()),
        ]
        for k, joint in enumerate(model.robot.moving)
    ]
    note = "For recorded motion; the generated functions take true positions, torques and currents."
    return join(element("p", note), table(heads, rows, class_="numbers"))


def _shown(value: sympy.Expr, symbol: str) -> str:
    number = minus(decimal(constant(value)))
    return f"{number}\u00a0{unit(symbol)}" if symbol != "1" else number
