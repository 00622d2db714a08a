"""Where the search ended from each of its starts."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.chart import ESTIMATED, MEASURED, axis, chart
from identification.report.output_error.subject import Subject
from identification.report.series import numbers

TITLE = "Starts"
ORDER = 60


def render(subject: Subject) -> Markup | None:
    found = subject.found
    if len(found.scores) < 2:
        return None
    ranked = sorted(found.scores.items(), key=lambda one: one[1])
    bars = {
        "type": "scatter",
        "mode": "markers",
        "x": [name for name, _ in ranked],
        "y": numbers(score for _, score in ranked),
        "marker": {"size": 9, "color": [ESTIMATED if name == found.chosen else MEASURED for name, _ in ranked]},
    }
    text = (
        "The criterion at the end of each start, the best first; one that is missing diverged. Starts that end at one"
        " height found the same minimum."
    )
    layout = {"xaxis": axis(""), "yaxis": axis("criterion")}
    return join(element("p", text), chart([bars], layout, "Criterion at the end of each start", height=260))
