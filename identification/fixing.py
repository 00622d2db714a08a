"""Parameters that are given instead of estimated: by name and value, or by name from a set of values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase

from generator import expressions
from generator.errors import InputError, Place
from generator.given_once import given_once
from generator.robot.fields import nearest
from generator.symbolic.bodies import INERTIAL
from generator.symbolic.model import Model

#: Word for all base parameters that stand for the bodies' inertia and weight.
BODIES = "bodies"


def fixed(requests: Sequence[str], prior: Mapping[str, float] | None, model: Model, place: Place) -> dict[str, float]:
    """Values by name for ``NAME=VALUE`` [SI], ``NAME``, a pattern such as ``Fv*``, or ``bodies``.

    What has no value of its own takes that of ``prior``. Raises InputError for a name that the robot does not have, for
    one given twice, and for a name without value where there is no prior.
    """
    given_once(requests, place)
    names = [parameter.name for parameter in model.base_parameters]
    result: dict[str, float] = {}
    for request in requests:
        wanted, equals, value = request.partition("=")
        chosen = _chosen(wanted, names, model)
        if not chosen:
            raise InputError(place, f"the robot has no base parameter {wanted!r}", nearest(wanted, names))
        for name in chosen:
            if name in result:
                raise InputError(place, f"{name} is given twice", "it once")
            if equals:
                result[name] = float(expressions.parse_number(value, place))
            elif prior is None:
                raise InputError(place, f"{name} has no value", f"{name}=VALUE, or a set of values to take it from")
            else:
                result[name] = prior[name]
    return result


def _chosen(wanted: str, names: Sequence[str], model: Model) -> list[str]:
    if wanted == BODIES:
        inertial = tuple(INERTIAL)
        return [
            base.name
            for base, parameter in zip(model.grouping.base, model.base_parameters, strict=True)
            if base.head.removesuffix(str(parameter.joint)) in inertial
        ]
    return [name for name in names if fnmatchcase(name, wanted)]
