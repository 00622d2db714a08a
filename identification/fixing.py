"""Parameters that are given instead of estimated: by name and value, or by name from a set of values."""

from __future__ import annotations

from collections.abc import Sequence
from fnmatch import fnmatchcase

from generator import expressions
from generator.effects.library import names_of_effects
from generator.errors import InputError, Place
from generator.given_once import given_once
from generator.robot.description import ParameterSet
from generator.robot.fields import nearest
from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import regrouped, resolved
from generator.words import listed
from identification.set_values import told

#: Word for all base parameters that stand for the bodies' inertia and weight.
BODIES = "bodies"


def fixed(
    requests: Sequence[str], prior: ParameterSet | None, model: Model, place: Place, option: str = ""
) -> dict[str, float]:
    """Values by name for ``NAME=VALUE`` [SI], ``NAME``, a pattern such as ``Fv*``, or ``bodies``.

    What has no value of its own takes that of ``prior``, which an ``option`` of the command names if it has one. Raises
    InputError for a name that the robot does not have, for one given twice, for a name without value where there is no
    prior, and for one of which the prior tells nothing.
    """
    given_once(requests, place)
    names = [parameter.name for parameter in model.base_parameters]
    values = {} if prior is None else resolved(model, prior.values)
    known = set() if prior is None else _known(model, prior)
    result: dict[str, float] = {}
    for request in requests:
        wanted, equals, value = request.partition("=")
        chosen = _chosen(wanted, names, model)
        if not chosen:
            raise _unknown(wanted, names, model, place)
        for name in chosen:
            if name in result:
                raise InputError(place, f"{name} is given twice", "it once")
            if equals:
                result[name] = float(expressions.parse_number(value, place))
            elif prior is None:
                raise InputError(
                    place, f"{name} has no value", f"{name}=VALUE{option and f', or {option} to take it from'}"
                )
            elif name not in known:
                problem = f"the set {prior.name} does not tell {name}"
                raise InputError(place, problem, f"{name}=VALUE, or a set of values that has it")
            else:
                result[name] = values[name]
    return result


def _unknown(wanted: str, names: Sequence[str], model: Model, place: Place) -> InputError:
    """The error of a name that no base parameter has; a standard one may be a part of others."""
    holders = [base.name for base in model.grouping.base if any(name == wanted for _, name in base.terms)]
    if holders:
        return InputError(place, f"{wanted} is grouped: the runs show it only in {listed(holders)}", listed(holders))
    if any(gone.name == wanted for gone in model.grouping.eliminated):
        return InputError(place, f"{wanted} acts in no torque", "a base parameter")
    return InputError(place, f"the robot has no base parameter {wanted!r}", nearest(wanted, names))


def _known(model: Model, prior: ParameterSet) -> set[str]:
    """Base parameters that a set tells, by themselves or by what they hold. A set of bodies tells those of all: what it
    lacks is zero. What only serves a sum is not told.
    """
    given = regrouped(model, {name: one for name, one in prior.values.items() if told(one)}).keys()
    bodies, effects = set(_chosen(BODIES, (), model)), names_of_effects(model.robot)
    parts = {name: {name, *terms} for name, terms in model.grouping.numeric().items()}
    of_bodies = {part for name in bodies for part in parts[name]} - effects
    return {name for name, own in parts.items() if given & (of_bodies if name in bodies else own)}


def _chosen(wanted: str, names: Sequence[str], model: Model) -> list[str]:
    if wanted == BODIES:
        inertial = tuple(INERTIAL_STEMS)
        return [
            base.name
            for base, parameter in zip(model.grouping.base, model.base_parameters, strict=True)
            if base.head.removesuffix(str(parameter.joint)) in inertial
        ]
    return [name for name in names if fnmatchcase(name, wanted)]
