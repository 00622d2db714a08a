"""Shares over a logarithmic axis as an SVG file of its own, readable on a light and on a dark page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import log

from benchmarks.diagnosis_study.pages.intervals import Share
from generator.review.markup import Markup, element
from generator.review.svg import pixel, points, svg, text

_WIDTH, _HEIGHT = 640.0, 340.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 60.0, 150.0, 34.0, 44.0
_COLORS = ("#2a78d6", "#c2571a", "#1a8f5a", "#8a4fbf")
_STYLE = """
text { font: 13px system-ui, sans-serif; fill: #333; }
.grid { stroke: #ccc; fill: none; }
.curve { fill: none; stroke-width: 2; } .band { stroke-width: 1.2; }
@media (prefers-color-scheme: dark) { text { fill: #ddd; } .grid { stroke: #444; } }
"""


def power_curve(title: str, curves: Mapping[str, Sequence[tuple[float, Share]]]) -> str:
    """Curves of shares over sizes, each point with its Wilson interval."""
    sizes = sorted({size for curve in curves.values() for size, _ in curve})

    def place(size: float, part: float) -> tuple[float, float]:
        along = log(size / sizes[0]) / log(sizes[-1] / sizes[0]) if len(sizes) > 1 else 0.5
        return (
            _LEFT + along * (_WIDTH - _LEFT - _RIGHT),
            _HEIGHT - _BOTTOM - part * (_HEIGHT - _TOP - _BOTTOM),
        )

    drawn: list[Markup] = [
        element("style", Markup(_STYLE)),
        text(_LEFT - 40, 18, "named, %", kind="name", anchor="start"),
        text(_WIDTH - _RIGHT, _HEIGHT - 6, "size of the effect over the noise", kind="name", anchor="end"),
    ]
    for percent in (0, 25, 50, 75, 100):
        y = place(sizes[0], percent / 100)[1]
        drawn.append(element("path", class_="grid", d=f"M {pixel(_LEFT)} {pixel(y)} H {pixel(_WIDTH - _RIGHT)}"))
        drawn.append(text(_LEFT - 6, y + 4, f"{percent}", kind="tick", anchor="end"))
    for size in sizes:
        drawn.append(text(place(size, 0)[0], _HEIGHT - _BOTTOM + 17, f"{size:g}", kind="tick"))
    names = []
    for k, (name, curve) in enumerate(curves.items()):
        color = _COLORS[k % len(_COLORS)]
        line = [place(size, one.hits / one.count) for size, one in curve]
        drawn.append(element("polyline", class_="curve", stroke=color, points=points(line)))
        for size, one in curve:
            (x, low), (_, high) = (place(size, part) for part in one.interval)
            drawn.append(
                element("path", class_="band", stroke=color, d=f"M {pixel(x + 2 * k)} {pixel(low)} V {pixel(high)}")
            )
        names.append((line[-1], name, color))
    last = 0.0
    for (x, y), name, color in sorted(names, key=lambda one: one[0][1]):
        last = max(y + 4, last + 16)
        drawn.append(text(x + 12, last, name, kind="name", anchor="start", style=f"fill: {color}"))
    return svg(_WIDTH, _HEIGHT, title, title, *drawn)
