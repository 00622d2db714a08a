"""Groupings: base parameters as sums of standard parameters, with the rule by which each parameter left."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy

from generator.grouping.linear_algebra import Matrix
from generator.grouping.observability import ROTOR_INERTIA, STEMS, Reach, base_reach, carried, invisible, moved
from generator.grouping.rigid_motion import transport
from generator.grouping.rules import elimination_order, rule_of, told
from generator.grouping.scalars import Numbers, Scalar
from generator.robot.description import Robot

#: A linear form: coefficients of standard parameters by name.
Form = dict[str, Scalar]


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
    gone = {name: _uses(name, base) for name in standard if name in rules}
    eliminated = tuple(Eliminated(name, told(rules[name], into), into) for name, into in gone.items())
    return Grouping(tuple(base), eliminated, values)


def _regroup(robot: Robot, standard: frozenset[str], numbers: Numbers) -> tuple[dict[str, Form], dict[str, str]]:
    """Linear forms of the kept parameters, and the rule of each eliminated one, by the recursion from the tips."""
    transports = {joint.number: transport(joint, numbers) for joint in robot.joints}
    by_antecedent = _by_antecedents(robot, transports, numbers)
    received: dict[int, list[Form]] = {joint.number: [{} for _ in STEMS] for joint in robot.joints}
    forms: dict[str, Form] = {}
    rules: dict[str, str] = {}
    for joint in reversed(robot.joints):
        j, order = joint.number, elimination_order(joint)
        names = [f"{stem}{j}" for stem in STEMS]
        present = [k for k, name in enumerate(names) if name in standard or (k < ROTOR_INERTIA and joint.tool)]
        entries = received[j]
        for k, name in enumerate(names):
            if name in standard:
                entries[k] = _sum(entries[k], {name: numbers.one}, numbers.one)
        leaving = invisible(joint, by_antecedent[j], present, order, numbers)
        onward = _taken_out(entries, leaving, order)
        if joint.antecedent:
            _hand_over(received[joint.antecedent], onward, transports[j])
        for vector in leaving:
            pivot = _pivot(vector, order)
            if names[pivot] in standard:
                rules[names[pivot]] = rule_of(joint, pivot, vector)
        for name, form in zip(names, entries, strict=True):
            if name in standard and name not in rules:
                forms[name] = form
    return forms, rules


def _by_antecedents(robot: Robot, transports: Mapping[int, Matrix], numbers: Numbers) -> dict[int, Reach]:
    """What its antecedent's motion alone makes each joint's frame do, by the joint's number."""
    reach = {0: base_reach(_gravity_in_frame_0(robot, numbers), numbers)}
    result = {}
    for joint in robot.joints:
        result[joint.number] = carried(joint, reach[joint.antecedent], transports[joint.number], numbers)
        reach[joint.number] = moved(joint, result[joint.number], numbers)
    return result


def _pivot(vector: Sequence[Scalar], order: Sequence[int]) -> int:
    """The parameter that an invisible combination eliminates."""
    return next(index for index in order if vector[index])


def _taken_out(entries: list[Form], leaving: Matrix, order: Sequence[int]) -> list[Form]:
    """Takes the invisible combinations ``leaving`` out of a joint's twelve linear forms; returns what they hold of the
    body's ten, which acts as parts of the antecedent.
    """
    onward: list[Form] = [{} for _ in range(ROTOR_INERTIA)]
    for vector in leaving:
        amount = entries[_pivot(vector, order)]
        for k, coefficient in enumerate(vector):
            if coefficient:
                entries[k] = _sum(entries[k], amount, -coefficient)
                if k < ROTOR_INERTIA:
                    onward[k] = _sum(onward[k], amount, coefficient)
    return onward


def _hand_over(receiver: list[Form], amounts: list[Form], matrix: Matrix) -> None:
    """Adds ten linear forms, seen from the antecedent, to the antecedent's."""
    for row, line in enumerate(matrix):
        for coefficient, amount in zip(line, amounts, strict=True):
            if coefficient and amount:
                receiver[row] = _sum(receiver[row], amount, coefficient)


def _sum(form: Form, other: Form, factor: Scalar) -> Form:
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
