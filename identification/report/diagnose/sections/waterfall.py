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
    search = subject.found.found
    if not search.choices:
        return None
    order = sorted(search.choices, key=lambda one: -one.evidence.drop)
    every = search.weighing.all
    columns: list[int] = []
    levels = [every.misfit(columns, every.solution(columns)[0])]
    names = ["model before"]
    for one in order:
        variant = one.evidence.variant
        columns += variant.columns
        levels.append(every.misfit(columns, every.solution(columns)[0]))
        names.append(variant.hypothesis.named)
    sizes = np.sqrt(np.array(levels) / max(every.rows, 1))
    steps = np.diff(sizes)
    data = {
        "type": "waterfall",
        "orientation": "h",
        "y": [*names, "model after"],
        "x": numbers([sizes[0], *steps, 0.0]),
        "measure": ["absolute", *["relative"] * len(steps), "total"],
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
    text = (
        "White residual, all joints together, of the runs that are fitted and that validate: as the model was, then"
        " with one finding after the other, parameters fitted anew each time. 1 is noise alone."
    )
    return join(element("p", text), chart([data], layout, TITLE, height=120 + _BAR * (len(names) + 1)))
