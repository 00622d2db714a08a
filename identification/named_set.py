"""A parameter set of a robot, by the name that a person gave."""

from __future__ import annotations

from generator.errors import InputError, Place
from generator.robot.description import ParameterSet, Robot
from generator.robot.fields import nearest
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import resolved

#: What a robot without any set needs.
_NONE = "one in section parameters of the robot file, which has none"


def named_set(robot: Robot, name: str, place: Place) -> ParameterSet:
    """The robot's set ``name``; raises InputError, at ``place``, where it has none of that name."""
    sets = robot.parameter_sets
    if name not in sets:
        raise InputError(place, f"{robot.name} has no parameter set {name!r}", nearest(name, sets) if sets else _NONE)
    return sets[name]


def resolved_set(model: Model, name: str, place: Place) -> dict[str, float]:
    """Values of all of ``model.parameters`` [SI] by name, by the set ``name``; raises InputError as ``named_set`` and
    ``resolved`` do.
    """
    return resolved(model, named_set(model.robot, name, place).values)
