"""Measured and estimated signal over time, and what is left below it."""

from __future__ import annotations

from collections.abc import Mapping

from generator.review.markup import Markup
from identification.arrays import Array
from identification.report.chart import COLOURS, ESTIMATED, MEASURED, RESIDUAL, Trace, axis, chart, line
from identification.report.series import thinned

#: Colours of the models after the first.
_OTHERS = (COLOURS[3], COLOURS[2], COLOURS[4])


def fit_chart(
    t: Array,
    measured: Array,
    estimated: Mapping[str, Array],
    name: str,
    unit: str,
    described: str,
    count: int,
    all_shown: bool = False,
) -> Markup:
    """Signals over times [s] (N each), ``count`` points a line; models after the first are shown on a click, or all."""
    curves = [line(*thinned(t, measured, count), "measured", f"{MEASURED}/45", line={"width": 4})]
    for k, (model, values) in enumerate(estimated.items()):
        colour, left = (ESTIMATED, RESIDUAL) if k == 0 else (_OTHERS[(k - 1) % len(_OTHERS)],) * 2
        common: Trace = {"legendgroup": model, "visible": all_shown or k == 0 or "legendonly"}
        below: Trace = {"yaxis": "y2", "showlegend": False, **common}
        curves.append(line(*thinned(t, values, count), model, colour, **common))
        curves.append(line(*thinned(t, measured - values, count), f"residual, {model}", left, **below))
    layout = {
        "xaxis": axis("time", "s", anchor="y2"),
        "yaxis": axis(name, unit, domain=[0.37, 1]),
        "yaxis2": axis("residual", unit, domain=[0, 0.29]),
    }
    return chart(curves, layout, described, height=470)
