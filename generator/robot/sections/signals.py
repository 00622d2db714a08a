"""Section ``signals``: how what is recorded differs from what the model means."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy

from generator.errors import InputError, Place
from generator.robot import fields
from generator.robot.description import FIXED, Joint, Signals
from generator.robot.document import Entry, Items, Node

#: A value beyond this is a mistake of its unit: no drive answers so late, and rms for peak current, or one motor of
#: two, makes less of a difference.
_LONGEST_DELAY = sympy.Rational(1, 10)
_LEAST_GAIN, _LARGEST_GAIN = sympy.Rational(3, 10), 3

Check = Callable[[Place, str, sympy.Expr, str], None]


def signals(entry: Entry | None, joints: Sequence[Joint], driven: bool) -> Signals:
    """The corrections of recorded signals: a list with one value per moving joint, or one value for all of them.

    ``driven`` tells whether the robot has drives; without, the motor of a slide gives a force.

    Raises InputError for another number of values, another unit, a delay over 0.1 s, one of link-side positions that is
    negative, a gain that is not between 0.3 and 3, a limit, time, rise or torque that is not positive.
    """
    if entry is None:
        return Signals()
    moving = [joint for joint in joints if joint.sigma != FIXED]
    position = [joint.position_unit for joint in moving]
    torque = [joint.motor_unit(driven) for joint in moving]
    kinds: dict[str, tuple[Sequence[str], Check]] = {
        "position_offset": (position, _any),
        "torque_gain": (["1"] * len(moving), _gain),
        "torque_delay": (["s"] * len(moving), _either_way),
        "link_delay": (["s"] * len(moving), _delay),
        "current_limit": (["A"] * len(moving), _positive("current")),
        "warm_up_time": (["s"] * len(moving), _positive("time")),
        "warm_rise": (["K"] * len(moving), _positive("rise of temperature")),
        "warm_torque": (torque, _positive("torque")),
    }
    keys = fields.table(entry.value, "signals", (), tuple(kinds))
    found = {key: _values(one.value, key, moving, *kinds[key]) for key, one in keys.items()}
    return Signals(**found)


def _values(
    node: Node, key: str, moving: Sequence[Joint], units: Sequence[str], check: Check
) -> tuple[sympy.Expr, ...]:
    nodes = fields.items(node, key, len(moving)) if isinstance(node, Items) else (node,) * len(moving)
    result = []
    for joint, item, unit in zip(moving, nodes, units, strict=True):
        what = f"{key} of joint {joint.number}"
        value = fields.number(item, what) if unit == "1" else fields.quantity(item, what, unit).value
        check(item.place, what, value, unit)
        result.append(value)
    return tuple(result)


def _any(place: Place, what: str, value: sympy.Expr, unit: str) -> None:
    """Every value is possible."""


def _gain(place: Place, what: str, value: sympy.Expr, unit: str) -> None:
    if not _LEAST_GAIN <= value <= _LARGEST_GAIN:
        raise InputError(place, f"{what} is {float(value):g}", "a factor from 0.3 to 3")


def _either_way(place: Place, what: str, value: sympy.Expr, unit: str) -> None:
    if not -_LONGEST_DELAY <= value <= _LONGEST_DELAY:
        raise InputError(place, f"{what} is {float(value):g} {unit}", "a time from -0.1 to 0.1 s")


def _delay(place: Place, what: str, value: sympy.Expr, unit: str) -> None:
    if not 0 <= value <= _LONGEST_DELAY:
        raise InputError(place, f"{what} is {float(value):g} {unit}", "a time from 0 to 0.1 s")


def _positive(expected: str) -> Check:
    def check(place: Place, what: str, value: sympy.Expr, unit: str) -> None:
        if value <= 0:
            raise InputError(place, f"{what} is {float(value):g} {unit}", f"a positive {expected}")

    return check
