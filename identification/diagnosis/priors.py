"""What is known of the base parameters before a run: a parameter set with its standard deviations."""

from __future__ import annotations

import numpy as np
import sympy

from generator.errors import InputError
from generator.robot.fields import nearest
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import resolved_sets
from identification.diagnosis.normal import Prior

#: Relative standard deviation of a value whose set tells none, and of what is zero, in parts of the largest of its unit.
_UNTOLD, _ZERO = 0.02, 1e-3


def prior_of(model: Model, name: str) -> Prior:
    """The set ``name`` of the robot, as values and standard deviations of its base parameters.

    Standard deviations of standard parameters add as independent ones. Raises InputError for an unknown set.
    """
    sets = model.robot.parameter_sets
    if name not in sets:
        problem = f"{model.robot.name} has no parameter set {name!r}"
        raise InputError(model.robot.place, problem, nearest(name, sets))
    values = resolved_sets(model)[name]
    given = sets[name].values
    largest: dict[str, float] = {}
    for one in given.values():
        largest[one.unit] = max(largest.get(one.unit, 0.0), abs(one.value))
    deviation = {
        key: max(
            abs(one.value) * (_UNTOLD if one.relative_std is None else one.relative_std / 100),
            _ZERO * largest[one.unit] * (one.relative_std is None),
        )
        for key, one in given.items()
    }
    lengths = {sympy.Symbol(length.name, real=True): length.value for length in model.robot.lengths}
    std = []
    for base, parameter in zip(model.grouping.base, model.base_parameters, strict=True):
        if parameter.name in given:
            std.append(deviation[parameter.name])
            continue
        terms = [(float(coefficient.subs(lengths)), key) for coefficient, key in base.terms]
        found = [abs(weight) * deviation[key] for weight, key in terms if key in deviation]
        std.append(float(np.linalg.norm(found)) if found else np.inf)
    mean = np.array([values[parameter.name] for parameter in model.base_parameters])
    # A parameter that is known exactly would make the sums of squares infinite.
    deviations = np.array(std)
    smallest = 1e-6 * max(float(np.max(deviations[np.isfinite(deviations)], initial=0.0)), 1e-12)
    return Prior(mean, np.maximum(deviations, smallest))
