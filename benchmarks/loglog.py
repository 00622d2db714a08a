"""Curves over logarithmic axes as an SVG file of its own, readable on a light and on a dark page."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from generator.review.markup import Markup, element
from generator.review.svg import pixel, points, svg, text

_WIDTH, _HEIGHT = 640.0, 360.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 60.0, 130.0, 34.0, 44.0
_Place = Callable[[float, float], tuple[float, float]]
_COLORS = ("#2a78d6", "#c2571a", "#1a8f5a", "#8a4fbf")
_STYLE = """
text { font: 13px system-ui, sans-serif; fill: #333; }
.grid { stroke: #ccc; fill: none; } .slope { stroke: #888; stroke-dasharray: 5 4; fill: none; }
.curve { fill: none; stroke-width: 2; }
@media (prefers-color-scheme: dark) { text { fill: #ddd; } .grid { stroke: #444; } }
"""


def loglog(
    title: str,
    across: str,
    upward: str,
    x: Sequence[float],
    curves: Mapping[str, Sequence[float]],
    slopes: Mapping[str, float],
) -> Markup:
    """``curves`` of positive values over ``x`` with ticks at every x and power of ten; dashed lines show ``slopes``.

    A dashed line of slope p is proportional to x^p and starts at the first point of the first curve.
    """
    values = [value for curve in curves.values() for value in curve]
    decades = range(math.floor(math.log10(min(values))), math.ceil(math.log10(max(values))) + 1)

    def place(a: float, b: float) -> tuple[float, float]:
        along = math.log(a / x[0]) / math.log(x[-1] / x[0])
        above = (math.log10(b) - decades[0]) / (decades[-1] - decades[0])
        return _LEFT + along * (_WIDTH - _LEFT - _RIGHT), _HEIGHT - _BOTTOM - above * (_HEIGHT - _TOP - _BOTTOM)

    drawn: list[Markup] = [
        element("style", Markup(_STYLE)),
        text(_LEFT - 40, 18, upward, kind="name", anchor="start"),
        text(_WIDTH - _RIGHT, _HEIGHT - 6, across, kind="name", anchor="end"),
    ]
    for decade in decades:
        at = place(x[0], 10.0**decade)[1]
        drawn.append(element("path", class_="grid", d=f"M {pixel(_LEFT)} {pixel(at)} H {pixel(_WIDTH - _RIGHT)}"))
        drawn.append(text(_LEFT - 6, at + 4, f"{10.0**decade:g}", kind="tick", anchor="end"))
    for tick in x:
        along = place(tick, values[0])[0]
        drawn.append(element("path", class_="grid", d=f"M {pixel(along)} {pixel(_TOP)} V {pixel(_HEIGHT - _BOTTOM)}"))
        drawn.append(text(along, _HEIGHT - _BOTTOM + 17, f"{tick:g}", kind="tick"))
    for name, power in slopes.items():
        drawn += _slope(name, power, x, values[0], 10.0 ** decades[-1], place)
    for color, (name, curve) in zip(_COLORS, curves.items(), strict=False):
        line = [place(a, b) for a, b in zip(x, curve, strict=True)]
        drawn.append(element("polyline", class_="curve", stroke=color, points=points(line)))
        drawn.append(text(line[-1][0] + 6, line[-1][1] + 4, name, kind="name", anchor="start", style=f"fill: {color}"))
    return svg(_WIDTH, _HEIGHT, title, f"{upward} over {across}", *drawn)


def _slope(name: str, power: float, x: Sequence[float], start: float, most: float, place: _Place) -> list[Markup]:
    end = min(x[-1], x[0] * (most / start) ** (1 / power))
    line = [place(x[0], start), place(end, start * (end / x[0]) ** power)]
    return [
        element("polyline", class_="slope", points=points(line)),
        text(line[1][0] - 6, line[1][1] - 6, name, kind="name", anchor="end"),
    ]
