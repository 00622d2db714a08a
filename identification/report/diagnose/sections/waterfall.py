"""From the residual of the model as it was down to the noise, finding by finding."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Markup, element, join
from identification.report.chart import ESTIMATED, HELD_OUT, RESIDUAL, axis, chart
from identification.report.diagnose.subject import Subject
from identification.report.diagnose.words import joints
from identification.report.series import numbers

TITLE = "From the start to the noise"
ORDER = 70


def render(subject: Subject) -> Markup | None:
    search = subject.found.found
    if not search.choices:
        return None
    order = sorted(search.choices, key=lambda one: -one.evidence.drop)
    normal, held = search.selection.normal, search.selection.held
    columns: list[int] = []
    levels = [held.misfit(columns, normal.solution(columns)[0])]
    names = ["model before"]
    for one in order:
        variant = one.evidence.variant
        columns += variant.columns
        levels.append(held.misfit(columns, normal.solution(columns)[0]))
        names.append(f"{variant.hypothesis.title}, {joints(variant.hypothesis.joints or (variant.hypothesis.joint,))}")
    sizes = np.sqrt(np.array(levels) / max(held.rows, 1))
    steps = np.diff(sizes)
    left = min(1.0, float(sizes[-1])) - sizes[-1]
    data = {
        "type": "waterfall",
        "x": [*names, "still unexplained", "noise"],
        "y": numbers([sizes[0], *steps, left, 0.0]),
        "measure": ["absolute", *["relative"] * len(steps), "relative", "total"],
        "decreasing": {"marker": {"color": ESTIMATED}},
        "increasing": {"marker": {"color": RESIDUAL}},
        "totals": {"marker": {"color": HELD_OUT}},
        "connector": {"line": {"color": "--rule", "width": 1}},
        "hovertemplate": "%{x}: %{y:.3g}<extra></extra>",
    }
    layout = {"yaxis": axis("rms residual, in the noise's", rangemode="tozero"), "xaxis": axis(""), "showlegend": False}
    text = (
        "White residual, all joints together, of the runs that validate and were not fitted: as the model was, then with"
        " one finding after the other, parameters fitted anew each time. 1 is noise alone."
    )
    return join(element("p", text), chart([data], layout, TITLE, height=320))
