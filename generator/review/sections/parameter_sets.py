"""The parameter sets of the robot file, side by side, each value with its accuracy and source."""

from __future__ import annotations

from generator.review.decimals import scientific
from generator.review.formula import Name
from generator.review.markup import Content, Markup, element, join, table
from generator.review.mathml import math
from generator.robot.description import ParameterSet, ParameterValue
from generator.symbolic.model import Model
from generator.words import minus, unit

TITLE = "Parameter sets"
ORDER = 120


def render(model: Model) -> Markup | None:
    sets = list(model.robot.parameter_sets.values())
    if not sets:
        return None
    sources = element(
        "dl",
        [
            element("div", element("dt", element("code", one.name)), element("dd", one.description, _source(one)), "\n")
            for one in sets
        ],
        class_="facts",
    )
    return join(sources, _values(model, sets), _others(sets), _notes(sets))


def _values(model: Model, sets: list[ParameterSet]) -> Markup:
    order = {p.name: p.unit for p in (*model.parameters, *model.standard_parameters)}
    units = {name: unit for name, unit in order.items() if any(name in one.values for one in sets)}
    rows: list[list[Content]] = [
        [math(Name(name)), unit(units[name]), *(_cell(one.values.get(name)) for one in sets)] for name in units
    ]
    return table(("parameter", "unit", *(element("code", one.name) for one in sets)), rows, class_="numbers")


def _others(sets: list[ParameterSet]) -> Markup | None:
    """What the same sources give beside parameters of the model."""
    rows: list[list[Content]] = [
        [element("code", name), unit(value.unit), _cell(value), element("code", one.name)]
        for one in sets
        for name, value in one.other_values.items()
    ]
    if not rows:
        return None
    title = element("h3", "Other values of these sources")
    return join(title, table(("name", "unit", "value", "set"), rows, class_="numbers"))


def _notes(sets: list[ParameterSet]) -> Markup | None:
    """What the file remarks on single values, each remark once with the values that it stands beside."""
    remarks: dict[tuple[str, str], list[str]] = {}
    for one in sets:
        for name, value in (*one.values.items(), *one.other_values.items()):
            if value.note:
                remarks.setdefault((one.name, value.note), []).append(name)
    if not remarks:
        return None
    rows: list[list[Content]] = [
        [", ".join(names), element("code", in_set), note] for (in_set, note), names in remarks.items()
    ]
    return join(element("h3", "Notes (*)"), table(("value", "set", "note"), rows, class_="remarks"))


def _cell(value: ParameterValue | None) -> Content:
    if value is None:
        return "·"
    hint = "; ".join(text for text in (value.note, value.source) if text) or None
    accuracy = None if value.relative_std is None else element("small", f" ± {value.relative_std:g} %")
    mark = element("span", "*", class_="mark") if value.note else None
    return element("span", _number(value.value), mark, accuracy, title=hint)


def _number(value: float) -> Content:
    mantissa, _, exponent = minus(scientific(value, 5)).partition("e")
    return join(mantissa, " · 10", element("sup", exponent)) if exponent else mantissa


def _source(one: ParameterSet) -> Markup | None:
    return element("small", f" {one.source}") if one.source else None
