"""What robot this is, and its model in a few numbers."""

from __future__ import annotations

import sympy

from generator.review.counts import ladder
from generator.review.formula import Formula, Name, formula
from generator.review.groupings import alone, without_effect
from generator.review.markup import Markup, element, join, table
from generator.review.mathml import mathml, matrix
from generator.robot.description import PRISMATIC
from generator.symbolic.model import Model
from generator.words import plural

TITLE = "Overview"
ORDER = 10


def render(model: Model) -> Markup:
    robot = model.robot
    moving = robot.moving
    prismatic = sum(joint.sigma == PRISMATIC for joint in moving)
    kinds = f"{len(moving) - prismatic} revolute" + (f", {prismatic} prismatic" if prismatic else "")
    stands_alone, lost = len(alone(model.grouping)), len(without_effect(model.grouping))
    cards = [
        _card(str(len(moving)), "moving joints" if len(moving) != 1 else "moving joint", kinds),
        _card(str(len(model.base_parameters)), "base parameters", f"of {len(model.standard_parameters)} standard ones"),
        _card(
            str(len(model.base_parameters) - stands_alone),
            "groupings",
            f"{stands_alone} stand alone, {lost} without effect",
        ),
        _card(str(len(model.functions)), "functions", f"of {plural(len(model.parameters), 'parameter')} in all"),
    ]
    counts = table(
        ("Columns of the regressor", "Base parameters"),
        ((stage.what, stage.total) for stage in ladder(model)),
        class_="counts",
    )
    facts = element(
        "dl",
        _fact("Source", robot.source) if robot.source else None,
        _fact("Gravity", _vector(robot.gravity), " m/s², acceleration of free fall in the world frame"),
        _fact("Frame 0", _base(robot.base)),
        class_="facts",
    )
    return join(element("div", cards, class_="cards"), element("div", facts, counts, class_="two"))


def _vector(components: tuple[sympy.Expr, ...]) -> Markup:
    """A column of numbers, laid down in one line."""
    entries: list[Formula] = [formula(component) for component in components]
    turned = element("msup", matrix([entries]), element("mi", "T"))
    return element("math", element("mrow", mathml(Name("g")), element("mo", "="), turned))


def _base(pose: sympy.ImmutableMatrix) -> Markup:
    if pose == sympy.eye(4):
        return join("stands in the world frame")
    entries = [[formula(entry) for entry in pose.row(i)] for i in range(4)]
    return join("in the world frame: ", element("math", matrix(entries)))


def _fact(name: str, *content: str) -> Markup:
    return element("div", element("dt", name), element("dd", *content))


def _card(number: str, what: str, more: str) -> Markup:
    return element("div", element("b", number), element("span", what), element("small", more), class_="card")
