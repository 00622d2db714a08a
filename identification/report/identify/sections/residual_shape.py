"""The residual over position and speed: what depends on them is an effect that the model lacks."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Markup, element, join
from identification.arrays import Array
from identification.report.chart import COLOURS, INK, Trace, axis, band, chart, line, points
from identification.report.choice import choice
from identification.report.identify.subject import ALL, Subject
from identification.report.series import binned, numbers, some

TITLE = "Residual over position and speed"
ORDER = 40

_DOTS = 700
_FORWARD, _BACKWARD = COLOURS[0], COLOURS[1]


def render(subject: Subject) -> Markup:
    text = (
        "Fitted runs together, model with all parameters. Dots are rows; lines are means of classes with equal numbers"
        " of rows, bands are two standard deviations of a mean to either side, for residuals as coloured as these."
        " Where a band leaves zero, something that depends on the position or the speed is not in the model."
    )
    panels = {f"{number}": _panel(subject, k, number) for k, number in enumerate(subject.numbers)}
    return join(element("p", text), choice("joint", "Joint", panels))


def _panel(subject: Subject, joint: int, number: int) -> Markup:
    rows = [run.torques[joint] for run in subject.runs if not run.held_out and joint in run.torques]
    signals = ([one.q for one in rows], [one.qd for one in rows], [one.residual(ALL) for one in rows])
    q, qd, e = (np.concatenate(each) for each in signals)
    if not len(e):
        return element("p", f"Joint {number} has no rows.")
    place = subject.position_units[number]
    across = [axis(f"q{number}", place), axis(f"qd{number}", f"{place}/s")]
    layout = {
        "xaxis": {**across[0], "domain": [0, 0.475]},
        "xaxis2": {**across[1], "domain": [0.525, 1], "anchor": "y2"},
        "yaxis": axis(f"residual of joint {number}", subject.torque_units[number]),
        "yaxis2": {"matches": "y", "anchor": "x2", "showticklabels": False},
    }
    data: list[Trace] = []
    for name, mine, colour in (("qd > 0", qd > 0, _FORWARD), ("qd < 0", qd < 0, _BACKWARD)):
        data += _class(q[mine], e[mine], name, colour, "")
    data += _class(qd, e, "all rows", INK, "2")
    return chart(data, layout, f"Residual of joint {number} over its position and its speed", height=380)


def _class(x: Array, e: Array, name: str, colour: str, at: str) -> list[Trace]:
    """Dots, and the means of classes with their band, on the axes ``at``."""
    chosen = some(len(x), _DOTS)
    place = {"xaxis": f"x{at}", "yaxis": f"y{at}"}
    dots = points(numbers(x[chosen]), numbers(e[chosen]), name, colour, showlegend=False, hoverinfo="skip", **place)
    dots["marker"] |= {"size": 3, "opacity": 0.22}
    means = binned(x, e)
    low, high = means.mean - 2 * means.std, means.mean + 2 * means.std
    across = numbers(means.x)
    drawn = [one | place for one in band(across, numbers(low), numbers(high), colour)]
    mean = line(across, numbers(means.mean), name, colour, **place, line={"width": 2.2})
    return [dots, *drawn, mean]
