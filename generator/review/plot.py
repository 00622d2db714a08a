"""Line plots as SVG: round ticks, units on the axes, one hover title a curve."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from generator.review.decimals import scientific
from generator.review.markup import Markup, element, join
from generator.review.svg import pixel, points, svg, text
from generator.words import minus

_WIDTH, _HEIGHT = 400.0, 250.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 58.0, 14.0, 26.0, 40.0


@dataclass(frozen=True)
class Curve:
    """Values over the common abscissa, with a name for the legend; the curve is interrupted where one is not finite."""

    name: str
    values: Sequence[float]


@dataclass(frozen=True)
class Marker:
    """A place on the abscissa worth a vertical line."""

    at: float
    name: str


def plot(
    title: str, across: str, upward: str, x: Sequence[float], curves: Sequence[Curve], markers: Sequence[Marker] = ()
) -> Markup:
    """Curves over ``x``; ``across`` and ``upward`` are the axes' labels with their units."""
    x_ticks = _ticks(min(x), max(x), 7)
    drawable = [value for curve in curves for value in curve.values if math.isfinite(value)]
    lowest, highest = min(drawable, default=0.0), max(drawable, default=0.0)
    y_ticks = _ticks(lowest, highest, 6)
    low, high = min(lowest, y_ticks[0]), max(highest, y_ticks[-1])

    def place(a: float, b: float) -> tuple[float, float]:
        along = (a - min(x)) / (max(x) - min(x)) if max(x) > min(x) else 0.5
        above = (b - low) / (high - low) if high > low else 0.5
        return _LEFT + along * (_WIDTH - _LEFT - _RIGHT), _HEIGHT - _BOTTOM - above * (_HEIGHT - _TOP - _BOTTOM)

    drawn = [text(_LEFT, 15, upward, kind="axis-name", anchor="start")]
    drawn.append(text(_WIDTH - _RIGHT, _HEIGHT - 6, across, kind="axis-name", anchor="end"))
    for tick in y_ticks:
        at = place(x[0], tick)[1]
        kind = "zero" if tick == 0 else "grid"
        drawn.append(element("path", class_=kind, d=f"M {pixel(_LEFT)} {pixel(at)} H {pixel(_WIDTH - _RIGHT)}"))
        drawn.append(text(_LEFT - 6, at + 4, _number(tick), kind="tick", anchor="end"))
    for tick in x_ticks:
        at = place(tick, low)[0]
        drawn.append(element("path", class_="grid", d=f"M {pixel(at)} {pixel(_TOP)} V {pixel(_HEIGHT - _BOTTOM)}"))
        drawn.append(text(at, _HEIGHT - _BOTTOM + 15, _number(tick), kind="tick"))
    for marker in markers:
        at = place(marker.at, low)[0]
        line = element("path", class_="marker", d=f"M {pixel(at)} {pixel(_TOP)} V {pixel(_HEIGHT - _BOTTOM)}")
        left = at > _WIDTH / 2
        drawn += [
            line,
            text(at + (-5 if left else 5), _TOP + 11, marker.name, kind="tick", anchor="end" if left else "start"),
        ]
    for k, curve in enumerate(curves):
        for piece in _pieces(x, curve.values):
            track = points(place(a, b) for a, b in piece)
            drawn.append(element("polyline", element("title", curve.name), class_=f"curve curve-{k % 6}", points=track))
    described = f"{upward} over {across}: {', '.join(curve.name for curve in curves)}."
    return svg(_WIDTH, _HEIGHT, title, described, join(*drawn, by="\n"), kind="plot")


def _pieces(x: Sequence[float], values: Sequence[float]) -> list[list[tuple[float, float]]]:
    """The stretches of a curve on which its values are finite."""
    runs = groupby(zip(x, values, strict=True), key=lambda at: math.isfinite(at[1]))
    return [list(run) for finite, run in runs if finite]


def _ticks(low: float, high: float, most: int) -> list[float]:
    """The round numbers inside a range, in ``most`` steps at the most."""
    span = high - low or abs(high) or 1.0
    power = 10.0 ** math.floor(math.log10(span / most))
    step = next(factor * power for factor in (1, 2, 2.5, 5, 10) if span / (factor * power) <= most)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [k * step for k in range(first, last + 1)] or [low]


def _number(value: float) -> str:
    return minus(scientific(value, 6))
