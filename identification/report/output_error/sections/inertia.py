"""Eigenvalues of the inertia matrix, which the search keeps positive (report fig. 33)."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Markup, element, join
from identification.report.chart import axis
from identification.report.eigenvalues import eigenvalue_chart
from identification.report.numbers import plain
from identification.report.output_error.subject import Subject
from identification.report.series import points_each

TITLE = "Inertia matrix along the runs"
ORDER = 50


def render(subject: Subject) -> Markup:
    best = subject.found.best
    text = (
        f"Eigenvalues of M(q) at the positions that the search looked at; it keeps them above {plain(best.margin, 3)}."
    )
    values = best.eigenvalues
    number = np.arange(1, len(values) + 1, dtype=float)
    count = points_each(values.shape[1])
    described = "Eigenvalues of the inertia matrix at positions of the runs"
    return join(
        element("p", text),
        eigenvalue_chart(number, values, axis("position number"), subject.torque_units, described, count),
    )
