"""Eigenvalues of the inertia matrix along the runs: bodies that can be have positive ones (report fig. 33)."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Markup, element, join
from identification.report.chart import COLOURS, axis, chart, line, log_axis
from identification.report.choice import choice
from identification.report.identify.subject import Subject
from identification.report.numbers import plain
from identification.report.series import line as thinned
from identification.report.series import points_each

TITLE = "Inertia matrix along the runs"
ORDER = 90


def render(subject: Subject) -> Markup:
    text = (
        "Eigenvalues of M(q) at the positions of the runs (report fig. 33). Where one is not positive, the model would"
        " accelerate against a torque, and a simulation or a computed-torque controller cannot use it."
    )
    panels = {
        model: choice("run", "Run", {run: _panel(subject, model, run) for run in runs})
        for model, runs in subject.eigenvalues.items()
    }
    return join(element("p", text), choice("model", "Model", panels))


def _panel(subject: Subject, model: str, run: str) -> Markup:
    t, values = subject.eigenvalues[model][run]
    units = set(subject.torque_units.values())
    of = "kg m2" if units == {"N m"} else "kg" if units == {"N"} else ""
    positive = bool(np.min(values) > 0)
    count = points_each(len(subject.runs) * len(subject.models) * values.shape[1])
    curves = [
        line(*thinned(t, values[:, k], count), f"λ{k + 1}", COLOURS[k % len(COLOURS)]) for k in range(values.shape[1])
    ]
    name = "eigenvalue of M"
    upward = log_axis(name, of, values.ravel().tolist()) if positive else axis(name, of)
    layout = {"xaxis": axis("time", "s"), "yaxis": upward}
    verdict = "all are positive" if positive else "not positive: these parameters are not those of bodies"
    caption = (
        f"Least eigenvalue {plain(float(np.min(values)), 4)}, largest {plain(float(np.max(values)), 4)}; {verdict}."
    )
    return chart(curves, layout, f"Eigenvalues of the inertia matrix in {run} with {model}", caption, height=320)
