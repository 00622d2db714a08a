"""The Denavit-Hartenberg table and the values of its lengths."""

from __future__ import annotations

from generator.review.formula import Name
from generator.review.geometry import length_value, limits, rows
from generator.review.markup import Content, Markup, element, join, table
from generator.review.mathml import math
from generator.robot.description import FIXED, PRISMATIC, REVOLUTE
from generator.symbolic.model import Model
from generator.words import minus, unit

TITLE = "Geometry"
ORDER = 30

_KINDS = {REVOLUTE: "revolute", PRISMATIC: "prismatic", FIXED: "fixed"}


def render(model: Model) -> Markup:
    listed = rows(model.robot)
    heads: list[Content] = ["j", "a(j)", math(Name("sigma_j"))]
    heads += [math(Name(f"{name}_j")) for name, _ in listed[0].cells]
    body: list[list[Content]] = [
        [
            row.label,
            row.joint.antecedent,
            join(
                row.joint.sigma, " ", element("small", _KINDS[row.joint.sigma] + (", tool" if row.joint.tool else ""))
            ),
            *(math(cell) for _, cell in row.cells),
            unit(minus(limits(row.joint))),
        ]
        for row in listed
    ]
    lengths: list[list[Content]] = [
        [
            math(Name(length.name)),
            minus(length_value(length)),
            "stays a parameter" if length.symbolic else "fixed",
        ]
        for length in model.robot.lengths
    ]
    intro = element(
        "p",
        "Modified Denavit–Hartenberg parameters: frame j follows from its antecedent a(j) by Rot(z, γ) Trans(z, b) "
        "Rot(x, α) Trans(x, d) Rot(z, θ) Trans(z, r)"
        + ("." if len(listed[0].cells) > 4 else "; γ and b are zero throughout."),
    )
    main = table([*heads, "limits"], body)
    if not lengths:
        return join(intro, main)
    return join(intro, element("div", main, table(("length", "value", "in the code"), lengths), class_="two"))
