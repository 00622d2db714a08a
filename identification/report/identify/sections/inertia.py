"""Eigenvalues of the inertia matrix along the runs: bodies that can be have positive ones (report fig. 33)."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.chart import axis
from identification.report.choice import choice
from identification.report.eigenvalues import eigenvalue_chart
from identification.report.identify.subject import Subject
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
    count = points_each(len(subject.runs) * len(subject.models) * values.shape[1])
    described = f"Eigenvalues of the inertia matrix in {run} with {model}"
    return eigenvalue_chart(t, values, axis("time", "s"), subject.torque_units.values(), described, count)
