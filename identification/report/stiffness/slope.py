"""Measured points, run by run, and the line through the origin that was found in them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from generator.review.markup import Markup
from identification.arrays import Array
from identification.report.chart import COLOURS, INK, Trace, chart, line, points
from identification.report.series import numbers, some

#: A run's name, and its numbers across and upward (N each).
Pair = tuple[str, Array, Array]

_POINTS = 1500


def slope_chart(
    pairs: Sequence[Pair], slope: float | None, name: str, across: Trace, upward: Trace, caption: str | None = None
) -> Markup:
    """Points, and the line of ``slope``, which ``name`` stands for; no line for None."""
    data: list[Trace] = []
    for k, (run, x, y) in enumerate(pairs):
        at = some(len(x), _POINTS)
        data.append(points(numbers(x[at]), numbers(y[at]), run, COLOURS[k % len(COLOURS)]))
    if slope is not None:
        ends = np.array([min(x.min() for _, x, _ in pairs), max(x.max() for _, x, _ in pairs)])
        data.append(line(numbers(ends), numbers(slope * ends), name, INK))
    layout = {"xaxis": across, "yaxis": upward, "showlegend": True}
    return chart(data, layout, f"Measurements and the line of {name}", caption, height=360)
