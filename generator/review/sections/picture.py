"""The arm, drawn from its geometry."""

from __future__ import annotations

import math as mathematics

from generator.review.formula import Name
from generator.review.markup import Markup, element, join
from generator.review.mathml import math
from generator.review.picture.arm import draw
from generator.robot.description import PRISMATIC
from generator.symbolic.model import Model

TITLE = "The arm"
ORDER = 20


def render(model: Model) -> Markup:
    drawing = draw(model.robot)
    figures = [
        element("figure", picture, element("figcaption", caption))
        for (name, picture), caption in zip(
            drawing.views,
            (
                f"{drawing.views[0][0]}: frames with x in red and z in blue, lengths as in the table below. "
                "A dot in a circle is an axis towards the reader, a cross one away.",
                f"{drawing.views[1][0]}: joint variables with their positive senses.",
            ),
            strict=True,
        )
    ]
    positions = []
    for joint, value in zip(model.robot.moving, drawing.q, strict=True):
        shown = f"{value:.3g} m" if joint.sigma == PRISMATIC else f"{round(mathematics.degrees(value))}°"
        positions += [math(Name(joint.variable.name)), f" = {shown.replace('-', '−')}, "]
    positions[-1] = positions[-1].rstrip(", ")
    note = element("p", "Drawn to scale at ", positions, ".", class_="note")
    return join(element("div", figures, class_="figures"), note)
