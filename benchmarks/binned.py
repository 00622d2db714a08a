"""Means of a residual over a variable as an SVG file of its own, readable on a light and on a dark page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from generator.review.markup import Markup, element
from generator.review.svg import pixel, points, svg, text
from generator.words import minus

_WIDTH, _HEIGHT = 720.0, 300.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 70.0, 20.0, 48.0, 44.0
_COLOURS = ("#3f7fbf", "#d98032")
#: Steps between ticks at most.
_TICKS = 6
_STYLE = """
text { font: 13px system-ui, sans-serif; fill: #24292f; }
.title { font-weight: 600; } .tick { font-size: 11.5px; }
.grid { stroke: #7d858f; stroke-opacity: 0.35; fill: none; }
.band { fill: #7d858f; fill-opacity: 0.3; }
.mean { fill: none; stroke-width: 2; } .after { stroke-dasharray: 5 4; }
@media (prefers-color-scheme: dark) { text { fill: #e6edf3; } }
"""


@dataclass(frozen=True)
class Curve:
    """Means over a variable, named; ``after`` ones are dashed. Those with the same ``colour`` belong together."""

    name: str
    x: Sequence[float]
    mean: Sequence[float]
    colour: int = 0
    after: bool = False


def _ticks(low: float, high: float) -> list[float]:
    """Round numbers from ``low`` to ``high``, with ``_TICKS`` steps at most."""
    power = 10.0 ** math.floor(math.log10((high - low) / _TICKS))
    step = next(power * k for k in (1, 2, 5, 10) if power * k * _TICKS >= high - low)
    return [round(k * step, 12) for k in range(math.ceil(low / step), math.floor(high / step) + 1)]


def binned(title: str, across: str, upward: str, curves: Sequence[Curve], band: Sequence[float]) -> str:
    """``curves`` with a grey band of half width ``band`` at the x of the first one."""
    xs = [x for one in curves for x in one.x]
    ys = [*(y for one in curves for y in one.mean), *band, *(-b for b in band)]
    low, high, down, up = min(xs), max(xs), min(ys), max(ys)

    def place(x: float, y: float) -> tuple[float, float]:
        along = (x - low) / (high - low) * (_WIDTH - _LEFT - _RIGHT)
        return _LEFT + along, _TOP + (up - y) / (up - down) * (_HEIGHT - _TOP - _BOTTOM)

    drawn: list[Markup] = [
        element("style", Markup(_STYLE)),
        text(0, 15, title, kind="title", anchor="start"),
        text(0, _TOP - 12, upward, kind="name", anchor="start"),
        text(_WIDTH - _RIGHT, _HEIGHT - 6, across, kind="name", anchor="end"),
    ]
    for y in _ticks(down, up):
        _, above = place(low, y)
        drawn.append(element("path", class_="grid", d=f"M {pixel(_LEFT)} {pixel(above)} H {pixel(_WIDTH - _RIGHT)}"))
        drawn.append(text(_LEFT - 6, above + 4, minus(f"{y:g}"), kind="tick", anchor="end"))
    for x in _ticks(low, high):
        along, _ = place(x, down)
        drawn.append(text(along, _HEIGHT - _BOTTOM + 17, minus(f"{x:g}"), kind="tick"))
    first = curves[0]
    upper = [place(x, b) for x, b in zip(first.x, band, strict=True)]
    lower = [place(x, -b) for x, b in zip(first.x, band, strict=True)]
    drawn.append(element("polygon", class_="band", points=points([*upper, *reversed(lower)])))
    start = _LEFT + 45
    for one in curves:
        colour = _COLOURS[one.colour % len(_COLOURS)]
        line = [place(x, y) for x, y in zip(one.x, one.mean, strict=True)]
        kind = "mean after" if one.after else "mean"
        drawn.append(element("polyline", class_=kind, stroke=colour, points=points(line)))
        mark = [(start, _TOP - 16), (start + 24, _TOP - 16)]
        drawn.append(element("polyline", class_=kind, stroke=colour, points=points(mark)))
        drawn.append(text(start + 30, _TOP - 12, one.name, kind="name", anchor="start"))
        start += 44 + 7.2 * len(one.name)
    return svg(_WIDTH, _HEIGHT, title, f"{upward} over {across}", *drawn) + "\n"
