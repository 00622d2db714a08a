"""Section ``signals``: how what is recorded differs from what the model means."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import sympy

from generator.errors import InputError, Place
from generator.robot import fields
from generator.robot.description import FIXED, Joint, Signals
from generator.robot.document import Entry, Items, Node
from generator.robot.signal_units import signal_unit

#: A value beyond this is a mistake of its unit: no drive answers so late, and rms for peak current, or one motor of
#: two, makes less of a difference.
_LONGEST_DELAY = sympy.Rational(1, 10)
_LEAST_GAIN, _LARGEST_GAIN = sympy.Rational(3, 10), 3

Check = Callable[[Place, str, sympy.Expr, str], None]


def signals(entry: Entry | None, joints: Sequence[Joint], driven: bool) -> Signals:
    """The corrections of recorded signals: a list with one value per moving joint, or one value for all of them.

    ``driven`` tells whether the robot has drives.

    Raises InputError for another number of values, another unit, a delay over 0.1 s, one of link-side positions that is
    negative, a gain that is not between 0.3 and 3, a limit, time, rise or torque that is not positive, and a value too
    large (``fields.check_size``).
    """
    if entry is None:
        return Signals()
    moving = [joint for joint in joints if joint.sigma != FIXED]
    keys = fields.table(entry.value, "signals", (), tuple(_CHECKS))
    return Signals(**{key: _values(one.value, key, moving, driven) for key, one in keys.items()})


def _values(node: Node, key: str, moving: Sequence[Joint], driven: bool) -> tuple[sympy.Expr, ...]:
    nodes = fields.items(node, key, len(moving)) if isinstance(node, Items) else (node,) * len(moving)
    result = []
    for joint, item in zip(moving, nodes, strict=True):
        what, unit = f"{key} of joint {joint.number}", signal_unit(key, joint, driven)
        value = fields.number(item, what) if unit == "1" else fields.quantity(item, what, unit).value
        fields.check_size(item.place, what, value, any_small=True)
        _CHECKS[key](item.place, what, value, unit)
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
        if float(value) <= 0:
            raise InputError(place, f"{what} is {float(value):g} {unit}", f"a positive {expected}")

    return check


_CHECKS: Mapping[str, Check] = {
    "position_offset": _any,
    "torque_gain": _gain,
    "torque_delay": _either_way,
    "link_delay": _delay,
    "current_limit": _positive("current"),
    "warm_up_time": _positive("time"),
    "warm_rise": _positive("rise of temperature"),
    "warm_torque": _positive("torque"),
}
