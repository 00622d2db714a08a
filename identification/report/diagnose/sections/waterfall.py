"""From the residual of the model as it was down to the noise, finding by finding."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Markup, element, join
from identification.report.chart import ESTIMATED, INK, MEASURED, RESIDUAL, axis, chart
from identification.report.diagnose.subject import Subject
from identification.report.series import numbers

TITLE = "From the start to the noise"
ORDER = 70

#: Height of a bar with what is around it [px].
_BAR = 38


def render(subject: Subject) -> Markup | None:
    steps = subject.found.steps
    if not steps.named:
        return None
    data = {
        "type": "waterfall",
        "orientation": "h",
        "y": ["model before", *steps.named, "model after"],
        "x": numbers([steps.sizes[0], *np.diff(steps.sizes), 0.0]),
        "measure": ["absolute", *["relative"] * len(steps.named), "total"],
        "decreasing": {"marker": {"color": ESTIMATED}},
        "increasing": {"marker": {"color": RESIDUAL}},
        "totals": {"marker": {"color": MEASURED}},
        "connector": {"line": {"color": "--rule", "width": 1}},
        "hovertemplate": "%{y}: %{x:.3g}<extra></extra>",
    }
    style = {"color": INK, "width": 1, "dash": "dash"}
    noise = {"type": "line", "yref": "paper", "y0": 0, "y1": 1, "x0": 1, "x1": 1, "line": style}
    place = {"yref": "paper", "y": 1, "yanchor": "bottom", "x": 1, "xanchor": "left"}
    layout = {
        "xaxis": axis("rms residual, in the noise's", rangemode="tozero"),
        "yaxis": axis("", autorange="reversed"),
        "showlegend": False,
        "shapes": [noise],
        "annotations": [{**place, "text": "noise", "showarrow": False}],
    }
    whose = "test, as fits to the others predict them" if steps.tested else "are fitted and validate"
    text = (
        f"White residual, all joints together, of the runs that {whose}: with the model as it was, then with one"
        " finding after the other, parameters fitted anew each time. 1 is the noise of the fitted and validating runs."
    )
    return join(element("p", text), chart([data], layout, TITLE, height=120 + _BAR * (len(steps.named) + 2)))
