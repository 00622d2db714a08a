"""The effects on the joints: their laws, fixed values, signs and assumptions."""

from __future__ import annotations

from collections.abc import Sequence

from generator.effects.library import Instance, unit_of
from generator.review.formula import Name
from generator.review.laws import alike, indexed, observables, rates, torque
from generator.review.markup import Content, Markup, element, join, table
from generator.review.mathml import math
from generator.review.stated import quantity
from generator.robot.description import Robot
from generator.symbolic.model import Model
from generator.words import bounds, minus, numbered, unit

TITLE = "Effects"
ORDER = 80


def render(model: Model) -> Markup | None:
    if not model.effects:
        return None
    intro = element("p", "Each adds its torque to that of the rigid bodies, on the side of the inverse dynamic model.")
    return join(intro, element("div", [_effect(one, model.robot) for one in alike(model.effects)], class_="effects"))


def _effect(instances: list[Instance], robot: Robot) -> Markup:
    first, effect = instances[0], instances[0].effect
    index = str(first.joint.number) if len(instances) == 1 else "j"
    told = observables(first)
    equations = [*(told or torque(first, index)), *rates(first, index)]
    return element(
        "article",
        element("h3", effect.title[:1].upper() + effect.title[1:]),
        element(
            "p",
            numbered("joint", [instance.joint.number for instance in instances]),
            " · ",
            element("code", effect.id),
            class_="where",
        ),
        [element("p", math(equation, display=True), class_="law") for equation in equations],
        element("p", [_parameter(instances, k, index) for k in range(len(effect.parameters))], class_="meanings"),
        [_values(instance, robot) for instance in instances if instance.site.values],
        element("p", "Sign: ", effect.sign_convention, "."),
        element("p", "Assumed: ", effect.assumptions, ".") if effect.assumptions else None,
        element("p", effect.source, class_="source"),
        "\n",
    )


def _parameter(instances: Sequence[Instance], k: int, index: str) -> list[Content]:
    parameter = instances[0].effect.parameters[k]
    name = Name(indexed(parameter.stem, index))
    within = bounds(parameter.lower, parameter.upper)
    joints: dict[str, list[int]] = {}
    for instance in instances:
        joints.setdefault(unit(parameter.unit(instance.joint)), []).append(instance.joint.number)
    units = (
        [f"{symbol} on {numbered('joint', numbers)}" for symbol, numbers in joints.items()]
        if len(joints) > 1
        else joints
    )
    return [math(name), f" {parameter.meaning} [{'; '.join(units)}]{f', {within}' if within else ''}. "]


def _values(instance: Instance, robot: Robot) -> Markup:
    values = instance.site.values
    rows = [
        (
            math(Name(shape.name)),
            unit(minus(quantity(values[shape.name], unit_of(shape, instance, robot)))),
            shape.meaning,
        )
        for shape in instance.effect.shapes
    ]
    return table(("value", f"on joint {instance.joint.number}", "meaning"), rows)
