"""Bars as SVG, to be read on a light and on a dark page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from generator.review.markup import Markup, element, join
from generator.review.svg import pixel, svg, text

_WIDTH, _LEFT, _RIGHT = 760.0, 150.0, 50.0
_TOP, _BAR, _GAP, _LEGEND = 34.0, 15.0, 12.0, 22.0
#: Of equal weight on white and on black.
_COLOURS = ("#3f7fbf", "#d98032", "#4d9e62", "#a86fc4", "#b8616b", "#8a8a3c")
_STYLE = """
text { font: 13px system-ui, sans-serif; fill: #24292f; }
.title { font-weight: 600; }
.value { font-size: 11.5px; }
.unit { stroke: #7d858f; stroke-dasharray: 3 3; }
@media (prefers-color-scheme: dark) { text { fill: #e6edf3; } }
"""


@dataclass(frozen=True)
class Group:
    """Bars that belong together, their lengths by name."""

    name: str
    bars: Mapping[str, float]


def chart(title: str, groups: Sequence[Group], unit: str) -> str:
    """Horizontal bars in groups, a legend above them, and a line at 1, which is ``unit``."""
    names = list(dict.fromkeys(name for group in groups for name in group.bars))
    longest = max(value for group in groups for value in group.bars.values())
    drawn = [element("style", _STYLE), text(0, 15, title, kind="title", anchor="start"), *_legend(names)]
    y = begin = _TOP + _LEGEND
    for group in groups:
        drawn.append(text(_LEFT - 10, y + _BAR * len(group.bars) / 2 + 4, group.name, kind="name", anchor="end"))
        for name, value in group.bars.items():
            length = _length(value, longest)
            colour = _COLOURS[names.index(name) % len(_COLOURS)]
            drawn.append(_bar(y, length, colour, f"{group.name}: {name} {value:.1f}"))
            drawn.append(text(_LEFT + length + 5, y + _BAR - 4, f"{value:.1f}", kind="value", anchor="start"))
            y += _BAR
        y += _GAP
    at = _LEFT + _length(1.0, longest)
    drawn.append(element("line", class_="unit", x1=pixel(at), x2=pixel(at), y1=pixel(begin - 4), y2=pixel(y - 4)))
    drawn.append(text(at, y + 8, f"1 = {unit}", kind="value"))
    described = "; ".join(f"{group.name}: {_told(group)}" for group in groups)
    return svg(_WIDTH, y + 14, title, described, join(*drawn, by="\n")) + "\n"


def _told(group: Group) -> str:
    return ", ".join(f"{name} {value:.1f}" for name, value in group.bars.items())


def _length(value: float, longest: float) -> float:
    return (_WIDTH - _LEFT - _RIGHT) * value / longest


def _bar(y: float, length: float, colour: str, told: str) -> Markup:
    shape = {"x": pixel(_LEFT), "y": pixel(y + 1), "width": pixel(length), "height": pixel(_BAR - 2)}
    return element("rect", element("title", told), fill=colour, **shape)


def _legend(names: Sequence[str]) -> list[Markup]:
    drawn, x = [], _LEFT
    for name, colour in zip(names, _COLOURS, strict=False):
        drawn.append(element("rect", x=pixel(x), y=pixel(_TOP - 10), width="11", height="11", fill=colour))
        drawn.append(text(x + 16, _TOP, name, kind="name", anchor="start"))
        x += 16 + 7.2 * len(name) + 18
    return drawn
