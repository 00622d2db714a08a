"""The groupings, typeset: symbolic and numeric, and where every other standard parameter went."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby

from generator.review.formula import Equation, Name
from generator.review.groupings import alone, equations, without_effect
from generator.review.markup import Content, Markup, element, join, table
from generator.review.mathml import math, terms
from generator.review.plain import plain
from generator.symbolic.model import Model
from generator.words import unit

TITLE = "Groupings"
ORDER = 40

_FORMS = (("both", "both"), ("symbolic", "symbolic"), ("numeric", "numeric"))


def render(model: Model) -> Markup:
    units = {parameter.name: parameter.unit for parameter in model.base_parameters}
    lines = [_line(units[base.name], symbolic, numeric) for base, symbolic, numeric in equations(model.grouping)]
    switches = [
        [
            element(
                "input", type="radio", name="form", id=f"form-{form}", checked="checked" if form == "both" else None
            ),
            element("label", text, for_=f"form-{form}"),
        ]
        for form, text in _FORMS
    ]
    return join(
        element("p", "A base parameter carries an R where other standard parameters are grouped into it."),
        element("div", switches, element("ul", lines, class_="equations"), class_="switched"),
        element("h3", "Parameters that stand alone"),
        _by_joint(model, alone(model.grouping)),
        element("h3", "Parameters without effect"),
        _by_joint(model, without_effect(model.grouping)),
        element("h3", "Why each parameter left"),
        _eliminated(model),
    )


def _line(symbol: str, symbolic: Equation, numeric: Equation) -> Markup:
    sides = [
        element("div", join(*terms(equation.right), by=" "), class_=kind, title=plain(equation))
        for kind, equation in (("symbolic", symbolic), ("numeric", numeric))
    ]
    name = element("div", math(symbolic.left), element("small", unit(symbol)), class_="name")
    return element("li", name, element("div", "=", class_="is"), element("div", sides, class_="sides"), "\n")


def _by_joint(model: Model, names: tuple[str, ...]) -> Markup:
    if not names:
        return element("p", "None.")
    joints = {parameter.name: parameter.joint for parameter in model.standard_parameters}
    rows = [(f"joint {joint}", _symbols(listed)) for joint, listed in groupby(names, key=lambda name: joints[name])]
    return element(
        "dl", [element("div", element("dt", joint), element("dd", listed)) for joint, listed in rows], class_="spread"
    )


def _eliminated(model: Model) -> Markup:
    """Parameters of one joint that left by one rule to one place share a row."""
    joints = {parameter.name: parameter.joint for parameter in model.standard_parameters}
    shared: dict[tuple[int, tuple[str, ...], str], list[str]] = {}
    for gone in model.grouping.eliminated:
        shared.setdefault((joints[gone.name], gone.into, gone.rule), []).append(gone.name)
    rows: list[list[Content]] = [
        [_symbols(names), rule, _symbols(into) if into else "no effect"] for (_, into, rule), names in shared.items()
    ]
    return table(("parameters", "rule", "went to"), rows, class_="rules")


def _symbols(names: Iterable[str]) -> Markup:
    return join(*(math(Name(name)) for name in names), by=" ")
