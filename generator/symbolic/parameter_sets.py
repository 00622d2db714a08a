"""From named parameter values, base or standard, to the vectors that the functions read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import sympy
from numpy.typing import NDArray

from generator.effects.library import lacking, names_of_effects
from generator.errors import InputError
from generator.robot.description import ParameterValue
from generator.robot.fields import nearest
from generator.robot.parameter_file import UNSTATED
from generator.robot.parameters import INERTIAL_STEMS, Parameter
from generator.symbolic.model import Model
from generator.symbolic.pseudo_inertia import of_body, possible

Vector = NDArray[np.float64]
Values = Mapping[str, ParameterValue]


def parameter_vector(model: Model, values: Values) -> Vector:
    """The vector ``parameters`` [SI], in the order of ``model.parameters``.

    Standard parameters become base parameters through the groupings. A base or standard parameter that ``values``
    lacks is zero (not essential); a length or a torque constant that it lacks is the robot's own.

    Raises InputError for an unknown name, a wrong unit, and base beside standard parameters.
    """
    values = regrouped(model, values)
    _, standard = _kinds(model, values)
    known = {name: value.value for name, value in values.items()} | (_grouped(model, values) if standard else {})
    vector = model.default_parameters()
    for index, parameter in enumerate(model.parameters):
        vector[index] = known.get(parameter.name, vector[index])
    return vector


def exact(value: ParameterValue) -> sympy.Rational:
    """The number of a set as it is written: 0.1 is 1/10."""
    return sympy.Rational(str(value.value))


def standard_vector(model: Model, values: Values) -> Vector:
    """The vector ``standard_parameters`` [SI], in the order of ``model.standard_parameters``; zero where not given.

    Raises InputError as ``parameter_vector`` does, and for a base parameter that was grouped: it has no one standard
    value.
    """
    base, _ = _kinds(model, values)
    if base:
        raise InputError(values[base[0]].place, f"{base[0]} is a base parameter", "standard parameters alone")
    return np.array([_number(values, parameter.name) for parameter in model.standard_parameters])


def regrouped(model: Model, values: Values) -> dict[str, ParameterValue]:
    """Values with the names of base parameters to which an effect of the robot has added its own since they were told:
    ``MX1`` beside others' ``ZZ1R`` is what of ``MX1R`` was alone.
    """
    numeric, standard = model.grouping.numeric(), {parameter.name for parameter in model.standard_parameters}
    if not any(name in numeric and name not in standard for name in values):
        return dict(values)
    of_effects = names_of_effects(model.robot)
    result = {}
    for name, value in values.items():
        more = f"{name}R"
        grown = (
            name not in numeric and more not in values and {name} < set(numeric.get(more, ())) <= {name} | of_effects
        )
        result[more if grown else name] = value
    return result


def shifted(model: Model, values: Values, name: str, more: float) -> dict[str, ParameterValue]:
    """Those of the base parameters ``values`` that hold the standard parameter ``name``, with ``more`` [SI] of it; they
    are as uncertain as before.
    """
    result = {}
    for base, terms in model.grouping.numeric().items():
        if name in terms and base in values:
            before = values[base]
            now = before.value + terms[name] * more
            spread = before.relative_std
            scaled = spread * abs(before.value / now) if spread is not None and now else None
            result[base] = replace(before, value=now, relative_std=scaled)
    return result


def resolved_sets(model: Model) -> dict[str, dict[str, float]]:
    """The robot's parameter sets by name, each as values of all of ``model.parameters``."""
    return {name: resolved(model, one.values) for name, one in model.robot.parameter_sets.items()}


def resolved(model: Model, values: Values) -> dict[str, float]:
    """Values of all of ``model.parameters`` [SI] by name; raises InputError as ``parameter_vector`` does."""
    names = [parameter.name for parameter in model.parameters]
    return dict(zip(names, parameter_vector(model, values).tolist(), strict=True))


def impossible(model: Model, values: Values, of: str = "") -> list[str]:
    """A note on each of ``values`` that is beyond physical bounds: a mass or a friction coefficient below zero.

    ``of`` tells whose values these are. The names are parameters of the model.
    """
    known = {one.name: one for one in (*model.all_parameters, *model.standard_parameters)}
    return [
        f"note: {value.place}: {name}{of} is {value.value:g}, which no robot can have"
        for name, value in values.items()
        if not known[name].allows(value.value)
    ]


def impossible_bodies(model: Model, values: Values, of: str = "") -> list[str]:
    """A note on each body whose ten parameters are all among ``values`` and which no matter can have."""
    return [
        f"note: {values[f'XX{number}'].place}: XX{number} to M{number}{of} are those of no body: "
        "about its centre of mass one moment of inertia is more than the sum of the two others"
        for number in (joint.number for joint in model.robot.bodies)
        if all(f"{stem}{number}" in values for stem in INERTIAL_STEMS)
        and not possible(of_body(number, {name: one.value for name, one in values.items()}))
    ]


#: Where a set's names are those of other groupings.
_REGROUPED = "a set of another geometry has other groupings, counterpoise review tells those of this file"


def _kinds(model: Model, values: Values) -> tuple[list[str], list[str]]:
    """The names of ``values`` that only base and that only standard parameters have, one of the two empty."""
    base = {parameter.name: parameter for parameter in model.all_parameters}
    standard = {parameter.name: parameter for parameter in model.standard_parameters}
    for name, value in values.items():
        _check(model, name, value, standard | base)
    base_only = [name for name in values if name not in standard and name in model.grouping.numbers]
    standard_only = [name for name in values if name not in base]
    if base_only and standard_only:
        raise InputError(
            values[standard_only[0]].place,
            f"the standard parameter {standard_only[0]} beside the base parameter {base_only[0]}",
            f"parameters of one kind; {_REGROUPED}" if f"{standard_only[0]}R" in base else "parameters of one kind",
        )
    return base_only, standard_only


def _check(model: Model, name: str, value: ParameterValue, known: Mapping[str, Parameter]) -> None:
    if name not in known:
        other = name.removesuffix("R") if name.endswith("R") else f"{name}R"
        regrouped = f"{other!r}, which is another sum; {_REGROUPED}" if other in known else ""
        expected = lacking(model.robot, name) or regrouped or nearest(name, known)
        raise InputError(value.place, f"the robot has no parameter {name!r}", expected)
    if value.unit not in (UNSTATED, known[name].unit):
        raise InputError(value.place, f"{name} is given in {value.unit}", known[name].unit)


def _grouped(model: Model, values: Values) -> dict[str, float]:
    """Base parameters [SI] as sums of standard ones, at the lengths of ``values`` where it has them."""
    numbers = model.grouping.numeric()
    if any(length.symbolic and length.name in values for length in model.robot.lengths):
        lengths = {
            sympy.Symbol(length.name, real=True): (
                exact(values[length.name]) if length.symbolic and length.name in values else length.value
            )
            for length in model.robot.lengths
        }
        numbers = {
            base.name: {name: float(coefficient.subs(lengths)) for coefficient, name in base.terms}
            for base in model.grouping.base
        }
    return {
        base: sum(coefficient * _number(values, name) for name, coefficient in terms.items())
        for base, terms in numbers.items()
    }


def _number(values: Values, name: str) -> float:
    return values[name].value if name in values else 0.0
