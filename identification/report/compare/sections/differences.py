"""All parameters of both sides."""

from __future__ import annotations

from generator.review.markup import Content, Markup, element, join, table
from generator.words import unit
from identification.comparison import AGREE, Comparison, Difference
from identification.parameter_source import Known
from identification.report.chart import COLOURS, axis, chart
from identification.report.numbers import NONE, number, percent
from identification.report.series import numbers

TITLE = "Differences"
ORDER = 20


def render(found: Comparison) -> Markup:
    heads = ("parameter", found.a.name, "std", found.b.name, "std", "difference", "in std", "unit", "")
    rows = table(heads, [_row(one) for one in found.differences.values()], class_="numbers")
    return join(_chart(found), rows)


def _chart(found: Comparison) -> Markup | None:
    told = [one for one in found.common if one.deviations is not None]
    if not told:
        return None
    bars = {
        "type": "bar",
        "x": [one.name for one in told],
        "y": numbers(one.deviations or 0.0 for one in told),
        "marker": {"color": [COLOURS[0] if one.agrees else COLOURS[1] for one in told]},
    }
    layout = {"xaxis": axis("", tickangle=-90, dtick=1, tickfont={"size": 10}), "yaxis": axis("difference", "std")}
    caption = f"Up to {AGREE:g} standard deviations the two agree; beyond, bars have the other colour."
    return chart([bars], layout, "Differences in standard deviations", caption, height=320)


def _row(one: Difference) -> list[Content]:
    apart = element("span", "apart", class_="state") if one.agrees is False else None
    sides = [*_side(one.a), *_side(one.b)]
    deviations = NONE if one.deviations is None else number(one.deviations, 3)
    return [element("code", one.name), *sides, percent(one.percent), deviations, unit(one.unit), apart]


def _side(known: Known | None) -> list[Content]:
    if known is None or known.value is None:
        return [NONE, NONE]
    return [number(known.value, 6), NONE if known.std is None else number(known.std, 3)]
