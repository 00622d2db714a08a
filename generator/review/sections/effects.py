"""The effects on the joints: their laws, fixed values, signs and assumptions."""

from __future__ import annotations

from generator.effects.library import Instance
from generator.review.formula import Name
from generator.review.laws import alike, observables, rates, torque
from generator.review.markup import Content, Markup, element, join, table
from generator.review.mathml import math
from generator.review.stated import quantity
from generator.review.words import minus, ranges, unit
from generator.symbolic.model import Model

TITLE = "Effects"
ORDER = 80


def render(model: Model) -> Markup | None:
    if not model.effects:
        return None
    intro = element("p", "Each adds its torque to that of the rigid bodies, on the side of the inverse dynamic model.")
    return join(intro, element("div", [_effect(instances) for instances in alike(model.effects)], class_="effects"))


def _effect(instances: list[Instance]) -> Markup:
    first, effect = instances[0], instances[0].effect
    index = str(first.joint.number) if len(instances) == 1 else "j"
    told = observables(first)
    equations = [*(told or torque(first, index)), *rates(first, index)]
    joints = ranges(instance.joint.number for instance in instances)
    return element(
        "article",
        element("h3", effect.title[:1].upper() + effect.title[1:]),
        element(
            "p",
            "joint " if len(instances) == 1 else "joints ",
            joints,
            " · ",
            element("code", effect.id),
            class_="where",
        ),
        [element("p", math(equation, display=True), class_="law") for equation in equations],
        element("p", [_parameter(first, k, index) for k in range(len(effect.parameters))], class_="meanings"),
        [_values(instance) for instance in instances if instance.site.values],
        element("p", "Sign: ", effect.sign_convention, "."),
        element("p", "Assumed: ", effect.assumptions, ".") if effect.assumptions else None,
        element("p", effect.source, class_="source"),
        "\n",
    )


def _parameter(instance: Instance, k: int, index: str) -> list[Content]:
    parameter = instance.effect.parameters[k]
    name = Name(f"{parameter.stem}{index}" if index.isdigit() else f"{parameter.stem}_{index}")
    bound = "" if parameter.lower is None else f", ≥\u00a0{parameter.lower:g}"
    bound += "" if parameter.upper is None else f", ≤\u00a0{parameter.upper:g}"
    return [math(name), f" {parameter.meaning} [{unit(parameter.unit(instance.joint))}]{bound}. "]


def _values(instance: Instance) -> Markup:
    values = instance.site.values
    rows = [
        (
            math(Name(shape.name)),
            unit(minus(quantity(values[shape.name], shape.unit_on(instance.joint)))),
            shape.meaning,
        )
        for shape in instance.effect.shapes
    ]
    return table(("value", f"on joint {instance.joint.number}", "meaning"), rows)
