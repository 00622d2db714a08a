"""The parameter vector of the generated functions, and the standard parameters behind it."""

from __future__ import annotations

from collections.abc import Iterable

from generator.review.formula import Name
from generator.review.markup import Markup, element, join, table
from generator.review.mathml import math
from generator.review.stated import built_in
from generator.robot.parameters import Parameter
from generator.symbolic.model import Model
from generator.words import bounds, minus, unit

TITLE = "Parameters"
ORDER = 125


def render(model: Model) -> Markup:
    standard = _table(model.standard_parameters)
    return join(
        _built_in(model) if model.constants else _vector(model),
        element(
            "details", element("summary", f"Standard parameters, {len(model.standard_parameters)} entries"), standard
        ),
    )


def _vector(model: Model) -> Markup:
    vector = _table(model.parameters)
    return join(
        element(
            "p",
            f"Order of the parameter vector of the generated functions: {len(model.base_parameters)} base parameters, "
            "then motor side, torque constants and symbolic lengths, as far as the robot has them.",
        ),
        element(
            "details", element("summary", f"Parameter vector, {len(model.parameters)} entries"), vector, open="open"
        ),
    )


def _built_in(model: Model) -> Markup:
    """The values in place of a parameter vector."""
    rows = ((math(Name(p.name)), unit(p.unit), minus(value), p.meaning) for p, value in built_in(model))
    values = table(("symbol", "unit", "value", "meaning"), rows, class_="numbers")
    return join(
        element("p", "These values stand in the generated functions as numbers; all other parameters are zero."),
        element("details", element("summary", "Parameters built in"), values, open="open"),
    )


def _table(parameters: Iterable[Parameter]) -> Markup:
    rows = (
        (
            str(index),
            math(Name(parameter.name)),
            element("code", parameter.name),
            unit(parameter.unit),
            parameter.meaning,
            bounds(parameter.lower, parameter.upper, parameter.positive),
        )
        for index, parameter in enumerate(parameters)
    )
    return table(("index", "symbol", "name", "unit", "meaning", "bound"), rows, class_="index")
