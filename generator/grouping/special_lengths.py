"""Groupings hold whatever symbolic lengths are: a nominal value at which a term vanishes by chance is refused."""

from __future__ import annotations

from dataclasses import replace

import sympy

from generator.errors import InputError
from generator.grouping.grouping import Grouping, group
from generator.robot.description import Length, Robot

#: By how much [m, rad] the first length is changed if it is symbolic, the second by twice as much, and so on. No
#: multiple is a length or an angle that a file would state.
_STEP = sympy.Rational(1009, 7919)


def general_grouping(robot: Robot, standard: tuple[str, ...]) -> Grouping:
    """The groupings of ``robot``, as ``grouping.group`` finds them, which are those of other symbolic lengths too.

    Raises InputError at the length whose nominal value makes them special, such as 0 or another length.
    """
    nominal = group(robot, standard)
    symbolic = [length.name for length in robot.lengths if length.symbolic]
    if not symbolic or group(elsewhere(robot, symbolic), standard).base == nominal.base:
        return nominal
    alone = (name for name in symbolic if group(elsewhere(robot, [name]), standard).base != nominal.base)
    name = next(alone, symbolic[0])
    length = next(length for length in robot.lengths if length.name == name)
    problem = f"the groupings at the nominal value of {name} are not those of other values, and {name} is symbolic"
    expected = f"a nominal value that is no special case, or 'symbolic: false' and {name} as it is"
    raise InputError(length.place, problem, expected)


def elsewhere(robot: Robot, names: list[str]) -> Robot:
    """The robot with each of some lengths changed by an amount of its own."""
    return replace(robot, lengths=tuple(_changed(k, one, names) for k, one in enumerate(robot.lengths, start=1)))


def _changed(k: int, length: Length, names: list[str]) -> Length:
    return replace(length, value=length.value + k * _STEP) if length.name in names else length
