"""Measured against estimated torque, and the residual below it, over time."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.reconstruction import Reconstruction
from identification.report.chart import ESTIMATED, HELD_OUT, MEASURED, RESIDUAL, Trace, axis, chart, line
from identification.report.choice import choice
from identification.report.identify.subject import ALL, ESSENTIAL, ShownRun, Subject
from identification.report.series import line as thinned
from identification.report.series import points_each

TITLE = "Measured and estimated torque"
ORDER = 30

_COLOURS = {ALL: ESTIMATED, ESSENTIAL: "--curve-3"}


def render(subject: Subject) -> Markup:
    text = (
        "Torques on the joint side as least squares sees them, filtered and decimated; below, what the model leaves."
        " Lines are interrupted where rows were left out. Click on a name to show or hide its curve."
    )
    shown = {
        f"{number}": choice(
            "run", "Run", {run.name: _panel(subject, run, k, number) for run in subject.runs if k in run.torques}
        )
        for k, number in enumerate(subject.numbers)
    }
    return join(element("p", text), choice("joint", "Joint", shown))


def _panel(subject: Subject, run: ShownRun, joint: int, number: int) -> Markup:
    one, symbol = run.torques[joint], subject.torque_units[number]
    if not len(one.t):
        return element("p", f"Joint {number} has no rows in this run.")
    count = points_each(len(subject.runs) * len(subject.numbers) * (1 + 2 * len(subject.models)))
    curves = [line(*thinned(one.t, one.measured, count), "measured", f"{MEASURED}/45", line={"width": 4})]
    for model in subject.models:
        curves += _model(one, model, count)
    layout = {
        "xaxis": axis("time", "s", anchor="y2"),
        "yaxis": axis(f"torque of joint {number}", symbol, domain=[0.37, 1]),
        "yaxis2": axis("residual", symbol, domain=[0, 0.29]),
    }
    described = f"Measured and estimated torque of joint {number} in {run.name}, and the residual"
    return chart(curves, layout, described, height=470)


def _model(one: Reconstruction, model: str, count: int) -> list[Trace]:
    """A model's torque and residual; one click on its name shows or hides both."""
    first = model == ALL
    colour = _COLOURS.get(model, HELD_OUT)
    common: Trace = {"legendgroup": model} if first else {"legendgroup": model, "visible": "legendonly"}
    below: Trace = {"yaxis": "y2", "showlegend": False, **common}
    return [
        line(*thinned(one.t, one.estimated[model], count), model, colour, **common),
        line(*thinned(one.t, one.residual(model), count), f"residual, {model}", RESIDUAL if first else colour, **below),
    ]
