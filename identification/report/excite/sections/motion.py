"""The motion itself, beside its limits."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Content, Markup, element, join, table
from identification.excitation.results import Excitation
from identification.report.chart import COLOURS, ESTIMATED, Trace, axis, chart, line
from identification.report.choice import choice
from identification.report.numbers import number
from identification.report.series import points_each, thinned

TITLE = "Motion"
ORDER = 20


def render(found: Excitation) -> Markup:
    panels = {f"{joint.number}": _panel(found, k) for k, joint in enumerate(found.robot.moving)}
    text = "Positions, speeds and accelerations that are wanted; dashed lines are limits."
    return join(element("p", text), choice("joint", "Joint", panels), _table(found))


def _panel(found: Excitation, k: int) -> Markup:
    joint, motion, limits = found.robot.moving[k], found.motion, found.limits
    unit = joint.position_unit
    t = np.arange(motion.samples) / found.request.rate
    signals = (
        (f"q{joint.number}", unit, motion.q[k], (limits.lower[k], limits.upper[k])),
        (f"qd{joint.number}", f"{unit}/s", motion.qd[k], (-limits.speed[k], limits.speed[k])),
        (f"qdd{joint.number}", f"{unit}/s2", motion.qdd[k], (-limits.acceleration[k], limits.acceleration[k])),
    )
    data: list[Trace] = []
    layout: dict[str, object] = {"xaxis": axis("time", "s", anchor="y3"), "showlegend": False}
    count = points_each(3 * len(found.robot.moving))
    ends = [float(t[0]), float(t[-1])]
    for i, (name, symbol, values, bounds) in enumerate(signals):
        at = "" if i == 0 else str(i + 1)
        data.append(line(*thinned(t, values, count), name, ESTIMATED, yaxis=f"y{at}"))
        for bound in bounds:
            style = {"width": 1, "dash": "dash"}
            data.append(line(ends, [float(bound)] * 2, "limit", COLOURS[1], line=style, yaxis=f"y{at}"))
        top = 1 - 0.345 * i
        layout[f"yaxis{at}"] = axis(name, symbol, domain=[top - 0.3, top])
    return chart(data, layout, f"Position, speed and acceleration of joint {joint.number}", height=520)


def _table(found: Excitation) -> Markup:
    motion, limits = found.motion, found.limits
    rows: list[list[Content]] = [
        [
            str(joint.number), number(float(motion.q[k].min()), 4), number(float(motion.q[k].max()), 4),
            number(float(np.abs(motion.qd[k]).max()), 4), number(float(limits.speed[k]), 4),
            number(float(np.abs(motion.qdd[k]).max()), 4), number(float(limits.acceleration[k]), 4),
        ]
        for k, joint in enumerate(found.robot.moving)
    ]  # fmt: skip
    heads = ("joint", "from", "to", "speed", "limit", "acceleration", "limit")
    return table(heads, rows, class_="numbers")
