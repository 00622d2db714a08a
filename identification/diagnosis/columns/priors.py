"""What is known of the base parameters before a run: a parameter set with its standard deviations."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np

from generator.command_line import command_line
from generator.effects.library import motor_side
from generator.robot.description import ParameterValue, Robot
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import regrouped, resolved, shifted
from generator.words import listed
from identification.arrays import Array
from identification.diagnosis.columns.normal_equations import Prior
from identification.named_set import named_set

#: Relative standard deviation of a value whose set tells none and of one that is known exactly; that of zero, and the
#: least of any value, which may be zero but for rounding, in parts of the largest of its unit.
_DEFAULT, _KNOWN, _ZERO, _ROUNDED = 0.05, 1e-4, 1e-3, 1e-9
#: Part of a variance by which parameters that are the same sums may differ.
_EXACT = 1e-6


def preferring(robot: Robot, name: str | None) -> Robot:
    """The robot with the set ``name``, if it has one, before the others: what no base parameter holds is told by the
    first set that has it.
    """
    sets = robot.parameter_sets
    first = {name: sets[name]} if name is not None and name in sets else {}
    return replace(robot, parameter_sets={**first, **sets})


def prior_of(model: Model, name: str) -> Prior:
    """The set ``name`` of the robot, as values and standard deviations of its base parameters.

    Standard deviations of standard parameters add as independent ones. A drive train of which the set has the motor
    side alone counts on its joint: rigid, both sides turn as one. A parameter of an effect that the set lacks is not
    known, nor is what it adds to the base parameters. Raises InputError for an unknown set.
    """
    prior, untold = _known(model, name)
    for direction in untold.values():
        prior = prior.shifted(direction, 0.0, np.inf)
    return prior


def notes_of(model: Model, name: str) -> list[str]:
    """What is to be told of the set ``name`` as a prior; raises InputError for an unknown set."""
    _, untold = _known(model, name)
    bases = [one.name for one in model.base_parameters]
    lacking = [
        f"{each} in {listed(base for base, part in zip(bases, direction, strict=True) if part)}"
        for each, direction in untold.items()
    ]
    return [f"the set {name} does not tell {listed(lacking)}: taken as unknown"] if lacking else []


def _known(model: Model, name: str) -> tuple[Prior, dict[str, Array]]:
    """What the set says, a missing parameter being zero in the sums of others, and what is not known (``_unknown``)."""
    told = _joined(model, named_set(model.robot, name, command_line("--prior")).values)
    given = regrouped(model, told)
    values = resolved(model, given)
    largest: dict[str, float] = {}
    for one in given.values():
        largest[one.unit] = max(largest.get(one.unit, 0.0), abs(one.value))
    # Where all of a unit are zero, none of them tells what is small.
    least = min((one for one in largest.values() if one), default=0.0)
    deviation = {key: _deviation(one, largest[one.unit] or least) for key, one in given.items()} | _refining(
        model, given
    )
    keys = list(deviation)
    map_ = np.zeros((len(model.base_parameters), len(keys)))
    lengths = model.robot.geometry
    for row, (base, parameter) in enumerate(zip(model.grouping.base, model.base_parameters, strict=True)):
        if parameter.name in deviation:
            map_[row, keys.index(parameter.name)] = 1.0
            continue
        for coefficient, key in base.terms:
            if key in deviation:
                map_[row, keys.index(key)] = float(coefficient.subs(lengths))
    mean = np.array([values[parameter.name] for parameter in model.base_parameters])
    prior = Prior(mean, _precision(map_ * np.array([deviation[key] for key in keys])))
    return prior, _unknown(model, told, given, prior)


def _unknown(
    model: Model, told: Collection[str], given: Mapping[str, ParameterValue], prior: Prior
) -> dict[str, Array]:
    """How much the base parameters hold (p) of each parameter of an effect that is not ``given``, by its name, where
    something would be known of one of them; those of which the set says all (``told``) hold nothing more.
    """
    names = [
        name
        for one in model.effects
        for name, parameter in zip(one.names, one.effect.parameters, strict=True)
        if not parameter.refines
    ]
    whole = np.array([one.name in told for one in model.base_parameters])
    parts = {each: np.where(whole, 0.0, model.grouping.coefficients(each)) for each in names if each not in given}
    return {each: part for each, part in parts.items() if np.any(part[prior.known])}


def _joined(model: Model, given: Mapping[str, ParameterValue]) -> dict[str, ParameterValue]:
    """Values with those of the motor side (Iam, Fvm, ...) on the joints, of which the set has none; in base parameters
    where those hold what is theirs.
    """
    standard, grouped = {one.name for one in model.standard_parameters}, model.grouping.numeric()
    of_bases = any(name in grouped and name not in standard for name in given)
    result = dict(given)
    for one in (each for each in motor_side(model.robot) if each.suffix):
        for motor, own in zip(one.names, one.on_joint, strict=True):
            if motor not in given or own in given or own not in standard:
                continue
            value = result.pop(motor)
            result |= shifted(model, result, own, value.value) if of_bases and own not in grouped else {own: value}
    return result


def _refining(model: Model, given: Mapping[str, ParameterValue]) -> dict[str, float]:
    """Standard deviations of coefficients that refine an effect of which the set has the others: such as the set does
    not tell are zero, to a part of the largest of those.
    """
    result = {}
    for one in model.effects:
        values = [given.get(name) for name in one.names]
        largest = max((abs(value.value) for value in values if value is not None), default=0.0)
        for name, parameter, value in zip(one.names, one.effect.parameters, values, strict=True):
            if parameter.refines and (value is None or value.value == 0) and largest:
                result[name] = _DEFAULT * largest
    return result


def _deviation(one: ParameterValue, largest: float) -> float:
    """Standard deviation of a value; no part of zero tells one, and none at all would be no knowledge."""
    if one.relative_std is None or one.value == 0:
        return max(_DEFAULT * abs(one.value), _ZERO * largest)
    return max(abs(one.value) * min(max(one.relative_std / 100, _KNOWN), 1 / _KNOWN), _ROUNDED * largest)


def _precision(root: Array) -> Array:
    """Inverse of root root^T (p x p) over the rows that are not zero; what is known exactly gets a small deviation."""
    known = np.flatnonzero(np.any(root != 0, axis=1))
    covariance = root[known] @ root[known].T
    size = np.sqrt(np.diag(covariance))
    scaled = covariance / np.outer(size, size) + _EXACT * np.eye(len(known))
    result = np.zeros((len(root), len(root)))
    result[np.ix_(known, known)] = np.linalg.inv(scaled) / np.outer(size, size)
    return result
