"""What a model leaves of the torques, joint by joint: held-out runs beside those that were fitted."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from generator.review.markup import Content, Markup, join, table
from generator.words import unit
from identification.report.chart import HELD_OUT, RESIDUAL, axis, chart
from identification.report.numbers import NONE, number, percent
from identification.report.series import numbers

_KINDS = {"train": ("fitted runs", RESIDUAL), "test": ("held-out runs", HELD_OUT)}


def norms(residual: Mapping[str, Any], units: Mapping[int, str], part: str = "joint") -> Markup:
    """A chart and a table of the key ``residual`` of results.json; ``units`` by the joint's number."""
    kinds = {kind: residual[kind] for kind in _KINDS if residual.get(kind) is not None}
    bars = [
        {
            "type": "bar",
            "name": _KINDS[kind][0],
            "x": [f"{part} {one['joint']}" for one in each["per_joint"]] + ["all"],
            "y": numbers(one["relative_to_mean_percent"] for one in (*each["per_joint"], each["total"])),
            "marker": {"color": _KINDS[kind][1]},
        }
        for kind, each in kinds.items()
    ]
    layout = {"yaxis": axis("‖e‖ / ‖Y − mean Y‖", "%"), "xaxis": axis(""), "bargap": 0.35, "showlegend": True}
    described = f"Residual of each {part} in percent of its torque's spread"
    return join(chart(bars, layout, described, height=250), _table(kinds, units, part))


def _table(kinds: Mapping[str, Any], units: Mapping[int, str], part: str) -> Markup:
    heads = [part]
    for kind in kinds:
        heads += [f"{_KINDS[kind][0]}, rows", "‖e‖", "‖e‖/‖Y‖", "‖e‖/‖Y − mean‖"]
    rows: list[list[Content]] = []
    for k, number_ in enumerate([one["joint"] for one in next(iter(kinds.values()))["per_joint"]]):
        rows.append([str(number_), *_cells(kinds, lambda each, k=k: each["per_joint"][k], unit(units[number_]))])
    same = next(iter(units.values())) if len(set(units.values())) == 1 else ""
    rows.append(["all", *_cells(kinds, lambda each: each["total"], unit(same))])
    return table(heads, rows, class_="numbers")


def _cells(kinds: Mapping[str, Any], pick: Any, symbol: str) -> list[Content]:
    cells: list[Content] = []
    for each in kinds.values():
        one = pick(each)
        if not one["rows"]:
            cells += [str(one["rows"]), NONE, NONE, NONE]
            continue
        shown = [number(one["norm"], 4), f"\u202f{symbol}"]
        cells += [str(one["rows"]), shown, percent(one["relative_percent"]), percent(one["relative_to_mean_percent"])]
    return cells
