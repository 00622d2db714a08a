"""The model with elastic drive trains."""

from __future__ import annotations

from generator.review.formula import Arguments, Call, Equation, Formula, Name, Negative, Product, Sum
from generator.review.laws import torque
from generator.review.markup import Markup, element, join
from generator.review.mathml import math
from generator.review.words import plural, ranges
from generator.symbolic.model import Model

TITLE = "Elastic drive trains"
ORDER = 110


def render(model: Model) -> Markup | None:
    if not model.elastic:
        return None
    joints = [model.robot.moving[k].number for k in model.elastic]
    first = [instance for instance in model.motor_effects if instance.joint.number == joints[0]]
    motor: list[Formula] = []
    for instance in first:
        for equation in torque(instance, "j"):
            right = equation.right
            motor += right.terms if isinstance(right, Sum) else [right]
    q_a = Equation(Name("q_a"), Sum((Name("q_m"), Name("q_e"))))
    stiff = Negative(Product((Name("k"), Name("q_e"))))
    inertia = Product((Call("M", Name("q_a")), Name("qdd_a")))
    rest = Call("H", Arguments((Name("q_a"), Name("qd_a"))))
    link = Equation(Name("tau_e"), Equation(stiff, Sum((inertia, rest))))
    body, side = len(model.base_parameters), len(model.motor_parameters)
    return join(
        element(
            "p",
            f"Joints {ranges(joints)}: an elastic coordinate between motor and joint, q = [",
            math(Name("q_m")),
            "; ",
            math(Name("q_e")),
            f"], {model.flexible_dof} in all.",
        ),
        element("p", math(q_a, display=True), class_="law"),
        element("p", math(Equation(Name("tau_m,j"), Sum(tuple(motor))), display=True), class_="law"),
        element("p", math(link, display=True), class_="law"),
        element(
            "p",
            f"The regressor has {body + side} columns: {body} base parameters of the link side and "
            f"{plural(side, 'parameter')} of the motor side.",
        ),
    )
