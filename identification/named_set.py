"""A parameter set of a robot, by the name that a person gave."""

from __future__ import annotations

from generator.errors import InputError, Place
from generator.robot.description import ParameterSet, Robot
from generator.robot.fields import nearest
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import resolved

#: What a robot without any set needs, and where it is to say how a robot moves what will do.
_NONE = "one in section parameters of the robot file, which has none"
_ROUGH = "; estimated values will do"


def named_set(robot: Robot, name: str, place: Place, default: str = "") -> ParameterSet:
    """The robot's set ``name``; raises InputError, at ``place``, where it has none of that name.

    ``default`` is the set that the option at ``place`` stands for where it is not given, if it does.
    """
    sets = robot.parameter_sets
    if name not in sets:
        problem = f"{robot.name} has no parameter set {name!r}"
        expected = nearest(name, sets) if sets else _NONE
        if name == default:
            problem += ", the default"
            expected += "" if sets else _ROUGH
        raise InputError(place, problem, expected)
    return sets[name]


def resolved_set(model: Model, name: str, place: Place) -> dict[str, float]:
    """Values of all of ``model.parameters`` [SI] by name, by the set ``name``; raises InputError as ``named_set`` and
    ``resolved`` do.
    """
    return resolved(model, named_set(model.robot, name, place).values)
