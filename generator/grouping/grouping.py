"""Groupings: base parameters as sums of standard parameters, with the rule by which each parameter left."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy

from generator.grouping.observability import ROTOR_INERTIA, base_reach, carried, invisible, moved
from generator.grouping.rigid_motion import transport
from generator.grouping.rules import elimination_order, rule_of
from generator.grouping.scalars import Numbers, Scalar
from generator.robot.description import Robot

#: Stems of the twelve parameters of a joint, in the order of ``observability``.
STEMS = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M", "Ia", "Off")


@dataclass(frozen=True)
class BaseParameter:
    """A base parameter: ``terms`` (coefficient, standard parameter) begin with the parameter that gave its name.

    Coefficients are exact expressions of the lengths' names. The name carries an R where anything was grouped.
    """

    name: str
    terms: tuple[tuple[sympy.Expr, str], ...]

    @property
    def head(self) -> str:
        """The standard parameter that stays: its column of the standard regressor is the base column."""
        return self.terms[0][1]

    @property
    def alone(self) -> bool:
        """Whether no other standard parameter is grouped with its head."""
        return len(self.terms) == 1


@dataclass(frozen=True)
class Eliminated:
    """A standard parameter without a column of its own; ``into`` names the base parameters it went to, if any."""

    name: str
    rule: str
    into: tuple[str, ...]


@dataclass(frozen=True)
class Grouping:
    """All groupings of a robot, in the order of the parameters."""

    base: tuple[BaseParameter, ...]
    eliminated: tuple[Eliminated, ...]
    numbers: Mapping[str, Mapping[str, float]]

    def numeric(self) -> dict[str, dict[str, float]]:
        """Base parameter -> {standard parameter: coefficient at the robot's lengths}."""
        return {name: dict(terms) for name, terms in self.numbers.items()}

    def coefficients(self, standard: str) -> list[float]:
        """How much of a standard parameter each base parameter holds, at the robot's lengths."""
        return [terms.get(standard, 0.0) for terms in self.numbers.values()]


def group(robot: Robot, standard: tuple[str, ...]) -> Grouping:
    """The groupings of ``robot`` for the standard parameters named in ``standard`` (those that are none of the twelve
    of ``STEMS`` stand alone).
    """
    numbers = Numbers(robot)
    forms, rules = _regroup(robot, frozenset(standard), numbers)
    base, values = [], {}
    for name in standard:
        if name in rules:
            continue
        form = forms.get(name, {name: numbers.one})
        ordered = [name, *(other for other in standard if other in form and other != name)]
        terms = tuple((numbers.expression(form[other]), other) for other in ordered)
        title = _title(name) if len(terms) > 1 else name
        base.append(BaseParameter(title, terms))
        values[title] = {other: float(form[other].value) for other in ordered}
    eliminated = tuple(Eliminated(name, rules[name], _uses(name, base)) for name in standard if name in rules)
    return Grouping(tuple(base), eliminated, values)


def _regroup(
    robot: Robot, standard: frozenset[str], numbers: Numbers
) -> tuple[dict[str, dict[str, Scalar]], dict[str, str]]:
    """Linear forms of the kept parameters, and the rule of each eliminated one, by the recursion from the tips."""
    gravity = _gravity_in_frame_0(robot, numbers)
    reach = {0: base_reach(gravity, numbers)}
    transports = {joint.number: transport(joint, numbers) for joint in robot.joints}
    by_antecedent = {}
    for joint in robot.joints:
        by_antecedent[joint.number] = carried(joint, reach[joint.antecedent], transports[joint.number], numbers)
        reach[joint.number] = moved(joint, by_antecedent[joint.number], numbers)
    received: dict[int, list[dict[str, Scalar]]] = {j.number: [{} for _ in STEMS] for j in robot.joints}
    forms: dict[str, dict[str, Scalar]] = {}
    rules: dict[str, str] = {}
    for joint in reversed(robot.joints):
        j = joint.number
        names = [f"{stem}{j}" for stem in STEMS]
        present = [k for k, name in enumerate(names) if name in standard or (k < ROTOR_INERTIA and joint.tool)]
        entries = received[j]
        for k, name in enumerate(names):
            if name in standard:
                entries[k] = _sum(entries[k], {name: numbers.one}, numbers.one)
        leaving = invisible(joint, by_antecedent[j], present, elimination_order(joint), numbers)
        onward: list[dict[str, Scalar]] = [{} for _ in range(10)]
        for vector in leaving:
            pivot = next(index for index in elimination_order(joint) if vector[index])
            amount = entries[pivot]
            for k, coefficient in enumerate(vector):
                if coefficient:
                    entries[k] = _sum(entries[k], amount, -coefficient)
                    if k < ROTOR_INERTIA:
                        onward[k] = _sum(onward[k], amount, coefficient)
            if names[pivot] in standard:
                rules[names[pivot]] = rule_of(joint, STEMS, pivot, vector)
        if joint.antecedent:
            _hand_over(received[joint.antecedent], onward, transports[j])
        for k, name in enumerate(names):
            if name in standard and name not in rules:
                forms[name] = entries[k]
    return forms, rules


def _hand_over(receiver: list[dict[str, Scalar]], amounts: list[dict[str, Scalar]], matrix: list[list[Scalar]]) -> None:
    """Adds ten linear forms, seen from the antecedent, to the antecedent's."""
    for row, line in enumerate(matrix):
        for coefficient, amount in zip(line, amounts, strict=True):
            if coefficient and amount:
                receiver[row] = _sum(receiver[row], amount, coefficient)


def _sum(form: dict[str, Scalar], other: dict[str, Scalar], factor: Scalar) -> dict[str, Scalar]:
    """form + factor * other, without the terms that vanish."""
    result = dict(form)
    for name, coefficient in other.items():
        total = result[name] + factor * coefficient if name in result else factor * coefficient
        if total:
            result[name] = total
        else:
            result.pop(name, None)
    return result


def _gravity_in_frame_0(robot: Robot, numbers: Numbers) -> list[Scalar]:
    """Gravity in frame 0; its size and direction count here, not how it is written."""
    local = robot.base[:3, :3].T * sympy.Matrix(robot.gravity)
    return [numbers.constant(component) for component in local]


def _uses(name: str, base: list[BaseParameter]) -> tuple[str, ...]:
    return tuple(parameter.name for parameter in base if any(term == name for _, term in parameter.terms))


def _title(name: str) -> str:
    return f"{name}R"
