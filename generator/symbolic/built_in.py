"""A robot whose parameters are numbers in the equations: what one parameter set gives, and zero for what it lacks.

Essential parameters (report eq. 47) make shorter equations this way: what is zero leaves them altogether.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from generator.effects.library import library
from generator.errors import InputError, Place
from generator.robot.description import EffectUse, Length, ParameterSet, Robot
from generator.robot.document import Text
from generator.robot.fields import nearest
from generator.robot.names import check_name
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import exact, parameter_vector

#: Where the name of the set is given.
_OPTION = Place("--build-in")


def built_in(robot: Robot, name: str, plain: bool = False) -> Model:
    """The model of ``robot`` with the parameter set ``name`` built in; it has no parameter vector.

    It is called ``<robot>_<set>``. A length or torque constant that the set lacks is the robot's own. Joints are
    elastic where the set gives their stiffness, and rigid elsewhere.

    Raises InputError if the robot has no such set, the set does not fit the robot or has a torque constant of zero, and
    where the two names together are none that generated code may have.
    """
    if name not in robot.parameter_sets:
        expected = nearest(name, robot.parameter_sets) if robot.parameter_sets else "a robot with parameter sets"
        raise InputError(_OPTION, f"no parameter set {name!r} in {robot.place.file}", expected)
    chosen = robot.parameter_sets[name]
    called = Text(f"{robot.name}_{name}", _OPTION)
    check_name(called)
    flexible = tuple(joint for joint in robot.flexible if f"k{joint}" in chosen.values)
    numeric = replace(
        robot,
        name=called.content,
        description="; ".join(filter(None, (robot.description, f"parameter set {name} built in"))),
        lengths=tuple(_number(length, chosen) for length in robot.lengths),
        flexible=flexible,
        effects=tuple(use for one in robot.effects if (use := _possible(one, flexible)).joints),
        parameter_sets={},
    )
    model = Model(numeric)
    known = {p.name for p in (*model.all_parameters, *model.standard_parameters)}
    elsewhere = {length.name for length in robot.lengths} | {p.name for p in Model(robot).motor_parameters}
    values = {key: value for key, value in chosen.values.items() if key in known or key not in elsewhere}
    vector = parameter_vector(model, values)
    constants = {p.name: Fraction(str(float(x))) for p, x in zip(model.all_parameters, vector, strict=True)}
    for kt in model.torque_constants:
        if not constants[kt.name]:
            problem = f"the torque constant {kt.name} of the set {name} is zero"
            raise InputError(chosen.values[kt.name].place, problem, "one that a torque can be divided by")
    return Model(numeric, plain, constants)


def _possible(use: EffectUse, flexible: Sequence[int]) -> EffectUse:
    """Without the joints of an elastic drive train that is none."""
    if "qe" not in library()[use.effect].needs:
        return use
    return replace(use, joints=tuple(joint for joint in use.joints if joint in flexible))


def _number(length: Length, chosen: ParameterSet) -> Length:
    if not length.symbolic:
        return length
    given = chosen.values.get(length.name)
    value = length.value if given is None else exact(given)
    return replace(length, value=value, symbolic=False)
