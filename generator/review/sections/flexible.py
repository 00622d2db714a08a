"""The model with elastic drive trains."""

from __future__ import annotations

from collections.abc import Sequence

from generator.effects.library import Instance
from generator.review.formula import Arguments, Call, Equation, Formula, Name, Product, Sum
from generator.review.laws import alike, torque
from generator.review.markup import Markup, element, join
from generator.review.mathml import math
from generator.symbolic.model import Model
from generator.words import numbered, plural

TITLE = "Elastic drive trains"
ORDER = 110


def render(model: Model) -> Markup | None:
    if not model.elastic:
        return None
    joints = [model.robot.moving[k].number for k in model.elastic]
    q_a = Equation(Name("q_a"), Sum((Name("q_m"), Name("q_e"))))
    body, side = len(model.base_parameters), len(model.motor_parameters)
    return join(
        element(
            "p",
            f"{_told(joints)}: an elastic coordinate between motor and joint, q = [",
            math(Name("q_m")),
            "; ",
            math(Name("q_e")),
            f"], {model.flexible_dof} in all.",
        ),
        element("p", math(q_a, display=True), class_="law"),
        [_laws(model, springs, len(springs) < len(joints)) for springs in alike(_springs(model))],
        element(
            "p",
            f"The regressor has {body + side} columns: {body} base parameters of the link side and "
            f"{plural(side, 'parameter')} of the motor side.",
        ),
    )


def _told(joints: Sequence[int]) -> str:
    return numbered("joint", joints).capitalize()


def _springs(model: Model) -> list[Instance]:
    return [instance for instance in model.motor_effects if "qe" in instance.effect.needs]


def _laws(model: Model, springs: Sequence[Instance], some: bool) -> Markup:
    """What motors and links do by springs of one law; their joints are told where only ``some`` have it."""
    joints = [spring.joint.number for spring in springs]
    here = [instance for instance in model.motor_effects if instance.joint.number == joints[0]]
    motor = [term for instance in here for term in _terms(instance)]
    inertia = Product((Call("M", Name("q_a")), Name("qdd_a")))
    rest = Call("H", Arguments((Name("q_a"), Name("qd_a"))))
    (pull,) = torque(springs[0], "j")
    link = Equation(Name("tau_e,j"), Equation(pull.right, Sum((inertia, rest))))
    return join(
        element("p", f"{_told(joints)}:") if some else None,
        element("p", math(Equation(Name("tau_m,j"), Sum(tuple(motor))), display=True), class_="law"),
        element("p", math(link, display=True), class_="law"),
    )


def _terms(instance: Instance) -> list[Formula]:
    rights = [equation.right for equation in torque(instance, "j")]
    return [term for right in rights for term in (right.terms if isinstance(right, Sum) else [right])]
