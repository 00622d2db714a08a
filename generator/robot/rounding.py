"""Numbers that are rounded where an exact one is meant: they make base parameters out of rounding.

A column of the regressor that should vanish is then some 1e-17 of the others, which no rank tells from zero.
"""

from __future__ import annotations

import sympy

from generator.errors import InputError, Place

#: Beyond this part of a turn's quarter two angles differ: 1.5708 is pi/2, and no arm is built to some 10 urad.
_NEARLY = 1e-5
#: A length [m], an angle [rad] or a part of gravity below this is zero.
_NOTHING = 1e-9


def check_angle(place: Place, what: str, angle: sympy.Expr) -> None:
    """Raises InputError for an angle [rad] that is all but a quarter turn, or all but zero."""
    quarters = round(float(2 * angle / sympy.pi))
    exact = quarters * sympy.pi / 2
    off = abs(float((angle - exact).evalf(30)))
    if off and off < (_NEARLY * abs(float(exact)) if quarters else _NOTHING):
        raise InputError(place, f"{what} is {exact} but for {off:.2g} rad", f"{90 * quarters} deg, which is exact")


def check_length(place: Place, what: str, length: sympy.Expr) -> None:
    """Raises InputError for a length [m] that is all but zero."""
    if 0 < abs(float(length)) < _NOTHING:
        raise InputError(place, f"{what} is {float(length):g} m", f"0 m, or at least {_NOTHING:g} m")


def check_gravity(place: Place, part: sympy.Expr, size: float) -> None:
    """Raises InputError for a part of gravity that is all but zero beside its ``size`` [m/s2]."""
    if 0 < abs(float(part)) < _NOTHING * size:
        raise InputError(place, f"gravity has a part of {float(part):g} m/s2", "0 m/s2")
