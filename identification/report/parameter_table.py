"""Parameters with their standard deviations, the least certain ones seen at a glance."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from generator.review.markup import Content, Markup, element, table
from generator.words import unit
from identification.report.numbers import NONE, number, percent

#: Relative standard deviations [%]: where the bars begin and end (their scale is logarithmic), and what is poor.
_LEAST, _LARGEST, _POOR = 0.01, 1000.0, 30.0
_WIDTH = 6.0


def parameter_table(
    parameters: Mapping[str, Mapping[str, Any]],
    states: Mapping[str, Content],
    beside: Mapping[str, Mapping[str, float]] | None = None,
) -> Markup:
    """The key ``parameters`` of results.json; ``states`` say what is special of some, ``beside`` are more columns."""
    beside = beside or {}
    rows: list[list[Content]] = []
    for name, one in parameters.items():
        certain = one["value"] is not None and math.isfinite(one["std"])
        rows.append([
            element("code", name),
            number(one["value"], 6),
            number(one["std"], 3) if certain else NONE,
            percent(one["relative_std_percent"]) if certain else NONE,
            _bar(one["relative_std_percent"]) if certain else None,
            unit(one["unit"]),
            *(number(values.get(name), 6) for values in beside.values()),
            states.get(name),
        ])  # fmt: skip
    heads = ("parameter", "value", "std", "relative std", "", "unit", *beside, "")
    return table(heads, rows, class_="numbers parameters")


def _bar(relative: float) -> Markup | None:
    """Its length grows with the logarithm of a relative standard deviation [%]."""
    if not math.isfinite(relative) or relative <= _LEAST:
        return None
    part = min(math.log(relative / _LEAST) / math.log(_LARGEST / _LEAST), 1.0)
    kind = "amount poor" if relative > _POOR else "amount"
    return element("i", "", class_=kind, style=f"width: {_WIDTH * part:.2f}rem")
