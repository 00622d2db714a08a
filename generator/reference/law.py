"""What the law of an effect is made of: the state that it sees, and what it answers per unit of each parameter."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from typing import Literal

Values = Mapping[str, Decimal]
Columns = tuple[Decimal, ...]
Ranges = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class At:
    """The motion that an effect acts along, and the fixed values ``shape``.

    ``direction`` stands for sign(qd). Along a motor, q, qd, qdd are its motion over its own gear ratio ``ratio``.
    ``load`` and ``warmth`` are those of the joint's drive, ``states`` the effect's own.
    """

    shape: Values
    q: Decimal
    qd: Decimal
    qdd: Decimal
    direction: Decimal
    ratio: Decimal
    load: Decimal = Decimal(0)
    warmth: Decimal = Decimal(0)
    states: Columns = ()


def _none(_: At) -> Columns:
    return ()


@dataclass(frozen=True)
class Law:
    """One effect: parameter ``stems``, and per unit of each its torque, pull F1 (balancers) and energies.

    ``states`` are the stems of its states, ``rates`` their derivatives. ``along`` is "joint", "motor" or
    "pair" (of joints that turn a rotor together): motor and pair share the torque by equal power. ``loads`` tells that
    it is a part of the drive's load at rest, ``by_load`` that it is proportional to the size of what loads the gear.
    ``ranges`` are those of its parameters in a mid-sized arm, by stem [SI], for the self-tests; ``defaults`` the fixed
    values that a robot file may leave out.
    """

    stems: tuple[str, ...]
    torque: Callable[[At], Columns]
    pull: Callable[[At], Columns] = _none
    potential: Callable[[At], Columns] = _none
    kinetic: Callable[[At], Columns] = _none
    states: tuple[str, ...] = ()
    rates: Callable[[At], Columns] = _none
    along: Literal["joint", "motor", "pair"] = "joint"
    loads: bool = False
    by_load: bool = False
    ranges: Ranges = field(default_factory=dict)
    defaults: Values = field(default_factory=dict)
