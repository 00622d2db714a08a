"""Torques of the other sign: friction and inertia that come out negative, and runs whose torques are the other way."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from generator.errors import InputError, Place
from generator.symbolic.model import Model
from identification.factors import Factor

#: Correlation of a run's torques with what a model makes of them from which their signs are others.
REVERSED = -0.5
#: What is asked of columns whose sign is wrong.
SENSE = "torques of the drives, and positions, of one sense; a sidecar can change the sign of either"
#: Standard deviations from which a parameter's sign is told for sure and from which it is likely; how many must be.
_SURE, _LIKELY, _SEVERAL = 4.0, 2.5, 2


def directed(
    place: Place, model: Model, values: Mapping[str, float], std: Mapping[str, float], aside: Collection[int] = ()
) -> None:
    """Raises InputError where all that a fit shows of friction and inertia that cannot be negative is, by far, of all
    joints or of one: the torques have the other sign. ``std`` are standard deviations by name, of what was fitted and
    shows. One of joints number ``aside`` tells nothing by itself.
    """
    sizes = above_zero(model, values, std)
    moving = set(model.robot.numbers)
    for joints in (moving, *({number} for number in sorted(moving.difference(aside)))):
        mine = [size for joint, size in sizes if joint in joints]
        sure = [size for size in mine if abs(size) > _SURE]
        likely = [size for size in mine if abs(size) > _LIKELY]
        if len(likely) >= _SEVERAL and max(likely) < 0 and sure:
            whose = "" if joints == moving else f" of joint {min(joints)}"
            problem = f"all friction and inertia that the torques{whose} show alone is negative"
            raise InputError(place, problem, SENSE)


def above_zero(model: Model, values: Mapping[str, float], std: Mapping[str, float]) -> list[tuple[int, float]]:
    """Friction and inertia that cannot be negative and a fit shows, each with its joint's number, in its standard
    deviations ``std``, those by name of what was fitted and shows.
    """
    storing = {name for one in model.effects if one.effect.potential_energy for name in one.names}
    return [
        (one.joint, values[one.name] / std[one.name])
        for one in model.base_parameters
        if one.lower == 0.0 and std.get(one.name) and one.name not in storing
    ]


def opposed(place: Place, run: Sequence[Factor], values: Mapping[str, float]) -> None:
    """Raises InputError where the torques of a ``run``, each joint's in parts of its size, are the other way than those
    that ``values`` of all parameters make along it.
    """
    pairs = [(one.R[:, -1] / one.norm, one.with_torques(values).R[:, -1] / one.norm) for one in run if one.norm]
    product, made = (sum(float(a @ b) for a, b in each) for each in (pairs, [(b, b) for _, b in pairs]))
    if product < REVERSED * np.sqrt(len(pairs) * made):
        raise another_sign(place, "those that are fitted")


def another_sign(place: Place, whose: str, of: str = "") -> InputError:
    """That torques of a run, those ``of`` a joint alone, have another sign than ``whose``."""
    problem = f"the torques{of} have another sign than {whose}"
    return InputError(place, problem, "one sign in all runs, of torques and of positions; a sidecar can change either")
