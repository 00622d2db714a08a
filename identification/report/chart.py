"""Charts: data and layout in plotly's terms, drawn by the page's script when they come to sight.

Colours are names of the style sheet's variables, so that charts follow the page's theme.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from generator.review.markup import Content, Markup, element
from generator.words import unit

#: Colours by what they stand for on every page.
MEASURED, ESTIMATED, RESIDUAL, HELD_OUT, INK = "--curve-5", "--curve-0", "--curve-1", "--curve-2", "--ink"
#: Colours of curves that stand for nothing in particular.
COLOURS = tuple(f"--curve-{k}" for k in range(6))

Trace = dict[str, Any]
#: Ratio of the ends of a logarithmic axis from which powers of ten suffice.
_WIDE = 30.0
#: Numbers of an axis, None for a gap.
Numbers = Sequence[float | None]


def chart(
    data: Sequence[Trace], layout: Mapping[str, Any], described: str, caption: Content = None, height: int = 340
) -> Markup:
    """A figure ``height`` px high; ``described`` tells it to those who cannot see it. Numbers must be finite."""
    text = json.dumps(
        {"data": list(data), "layout": {**layout, "height": height}}, separators=(",", ":"), allow_nan=False
    )
    # No figure element: the style sheet gives the pictures inside one a size of their own.
    return element(
        "div",
        element("div", "", class_="chart", role="img", aria_label=described, style=f"height: {height}px"),
        element("script", Markup(text.replace("<", "\\u003c")), type="application/json"),
        element("p", caption, class_="legend") if caption else None,
        class_="charted",
        role="figure",
    )


def axis(text: str, of: str = "", **more: Any) -> dict[str, Any]:
    """An axis with its title, and its unit in brackets."""
    return {"title": {"text": f"{text} [{unit(of)}]" if of else text}, **more}


def log_axis(text: str, of: str, values: Iterable[float], **more: Any) -> dict[str, Any]:
    """A logarithmic axis, its labels at powers of ten where the ``values`` span several."""
    positive = [value for value in values if value > 0]
    wide = bool(positive) and max(positive) > _WIDE * min(positive)
    labels = {"dtick": 1, "minor": {"ticks": "outside", "ticklen": 2}} if wide else {}
    return axis(text, of, type="log", exponentformat="power", **labels, **more)


def line(x: Numbers, y: Numbers, name: str, colour: str, **more: Any) -> Trace:
    """A thin line; None in ``y`` interrupts it."""
    style = {"color": colour, "width": 1.4, **more.pop("line", {})}
    return {"type": "scatter", "mode": "lines", "x": x, "y": y, "name": name, "line": style, **more}


def points(x: Numbers, y: Numbers, name: str, colour: str, **more: Any) -> Trace:
    """Small dots that darken where they are many."""
    marker = {"color": colour, "size": 3.5, "opacity": 0.45}
    return {"type": "scatter", "mode": "markers", "x": x, "y": y, "name": name, "marker": marker, **more}


def band(x: Numbers, low: Numbers, high: Numbers, colour: str) -> list[Trace]:
    """The area between two lines, without a name of its own."""
    edge = {"type": "scatter", "mode": "lines", "line": {"width": 0}, "hoverinfo": "skip", "showlegend": False}
    filled = {"fill": "tonexty", "fillcolor": f"{colour}/18"}
    return [{**edge, "x": x, "y": low}, {**edge, "x": x, "y": high, **filled}]
