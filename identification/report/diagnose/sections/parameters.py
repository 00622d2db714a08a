"""The new model's parameters, with their uncertainty."""

from __future__ import annotations

import math
from typing import Any

from generator.review.markup import Content, Markup, element, join
from identification.report.diagnose.subject import Subject
from identification.report.parameter_table import parameter_table

TITLE = "Parameters of the new model"
ORDER = 100


def render(subject: Subject) -> Markup | None:
    mended = subject.mended
    if mended is None:
        return None
    old = {one.name for one in subject.found.search.bank.scenes[0].regressors.model.base_parameters}
    units = {one.name: one.unit for one in mended.fit.regressors.model.base_parameters}
    rows: dict[str, dict[str, Any]] = {}
    states: dict[str, Content] = {}
    for name, unit in units.items():
        value, std = mended.fit.values.get(name), mended.fit.std.get(name, math.inf)
        known = value is not None and math.isfinite(std)
        relative = 100 * std / abs(value) if known and value else math.inf
        rows[name] = {"value": value if known else None, "std": std, "relative_std_percent": relative, "unit": unit}
        states[name] = element("span", "new", class_="state") if name not in old else None
    text = (
        "Fitted anew to the fitted runs, with the findings in place that the file holds; standard deviations allow for"
        " the colour of the residuals. The robot file has them as the set "
    )
    return join(element("p", text, element("code", mended.fit.parameter_set.name), "."), parameter_table(rows, states))
