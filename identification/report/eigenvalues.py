"""Eigenvalues of the inertia matrix along a motion: bodies that can be have positive ones (report fig. 33)."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from generator.review.markup import Markup
from identification.arrays import Array
from identification.report.chart import COLOURS, Trace, axis, chart, line, log_axis
from identification.report.numbers import plain
from identification.report.series import thinned


def eigenvalue_chart(
    x: Array, values: Array, across: Trace, torque_units: Collection[str], described: str, count: int
) -> Markup:
    """Eigenvalues (N x n) over ``x`` (N), ``count`` points a line; ``torque_units`` are those of the joints."""
    units = set(torque_units)
    of = "kg m2" if units == {"N m"} else "kg" if units == {"N"} else ""
    positive = bool(np.min(values) > 0)
    curves = [
        line(*thinned(x, values[:, k], count), f"λ{k + 1}", COLOURS[k % len(COLOURS)]) for k in range(values.shape[1])
    ]
    name = "eigenvalue of M"
    upward = log_axis(name, of, values.ravel().tolist()) if positive else axis(name, of)
    verdict = "all are positive" if positive else "not positive: these parameters are not those of bodies"
    least, largest = float(np.min(values)), float(np.max(values))
    caption = f"Least eigenvalue {plain(least, 4)}, largest {plain(largest, 4)}; {verdict}."
    return chart(curves, {"xaxis": across, "yaxis": upward}, described, caption, height=320)
