"""What a law of the simulated robot is: one file of ``laws/`` each, found by being there.

A law either is a torque, written in C, or changes the robot before it moves (``change``), or what is read of it
afterwards (``reading``). Torques have the sign of the inverse model: positive ones must be supplied by the motor.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import inf
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine
    from tests.plant.robot import Robot

#: A number, or what it is on a joint (from 0) of a robot.
Value = float | Callable[["Robot", int], float]


@dataclass(frozen=True)
class Law:
    """``size`` scales the law continuously; 0 is none of it. ``unit`` is that of size; on a prismatic joint m stands
    for rad.

    ``torque`` is the body of a C function. It sees size, the values by name, t and h [s], of the joint (or of the sum
    over weighted joints): q, qd link side, th, v motor side, load (torque that the gear transmits) and friction (of
    all laws that are friction, before this one); v_other of the effect's other joint; rotor, the motor's angle; state
    s[]; bristle(), wander(), coldness() of c/parts.c.
    """

    about: str
    unit: str
    typical: Value
    values: Mapping[str, Value] = field(default_factory=dict)
    #: Beyond it the law makes no sense: more Coulomb friction replaced than there is.
    largest: Value = inf
    #: Whether it stands in the place of Coulomb friction, as much as its size.
    replaces_coulomb: bool = False
    torque: str = ""
    friction: bool = False
    of_links: bool = False
    #: Acts along the motor's share of the joints' speeds, where the effect has no weights of its own.
    of_rotor: bool = False
    #: Acts along the row of the motor in the gear ratios, where the effect has no weights of its own: what repeats with
    #: the motor's turn does no work in a whole one.
    of_motor: bool = False
    change: Callable[[Machine, Effect], None] | None = None
    #: What it does to the readings: command (of currents), delay (of positions) or link_latency; size is its amount.
    reading: str = ""
    #: Not meant to be in any library of candidates.
    outside: bool = False


def value_of(value: Value, robot: Robot, joint: int) -> float:
    """A value of a law on a joint (from 0)."""
    return float(value(robot, joint) if callable(value) else value)


def stiff_way(robot: Robot, joint: int) -> float:
    """Way [rad] after which a stiff bristle of the joint's Coulomb friction slips: as stiff as the rotor at 2000
    rad/s.
    """
    here = robot.chain[joint]
    return max(2e-6, here.coulomb / (here.rotor * 2000.0**2))
