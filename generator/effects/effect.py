"""What an effect is: anything that adds torque to the rigid chain, stated in one file of its own.

The torque is linear in the effect's parameters: on joint i it is the sum over its parameters p of p * column[p][i].
What enters otherwise (a length, an exponent, a speed) is a shape value, fixed in the robot file. A column may also read
the load of the joint, the warmth of its drive and states of the effect itself, whose rates the effect then states.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import sympy

from generator.robot.description import PRISMATIC, REVOLUTE, Joint

#: How many robots have an effect: nearly all, or many of those that can have it.
EVERYWHERE, OFTEN = "everywhere", "often"
#: What an effect does beside friction and inertia: hold an arm up, or pull a link to where it rests in another way.
BALANCER, SPRING = "balancer", "spring"

#: What effects on the motor side of an elastic joint may need.
OF_MOTOR_SIDE = ("q", "qd", "qdd", "qe")

#: Torque per unit parameter on each joint, by joint number.
Column = Mapping[int, sympy.Expr]


@dataclass(frozen=True)
class LinearParameter:
    """A parameter that multiplies a regressor column. The name is ``stem`` and the joint's number.

    ``units`` are those on a revolute and on a prismatic joint; ``lower`` and ``upper`` are the physical bounds, None if
    free. One that ``refines`` the others is sought only where runs ask for it.
    """

    stem: str
    units: tuple[str, str]
    meaning: str
    lower: float | None = None
    upper: float | None = None
    refines: bool = False

    def unit(self, joint: Joint) -> str:
        """The unit on this joint, which is revolute or prismatic."""
        return self.units[joint.sigma == PRISMATIC]


@dataclass(frozen=True)
class Shape:
    """A fixed value of an effect: its unit, what it is, open physical bounds (None where free), a default if any.

    ``prismatic`` is the unit on a prismatic joint, where it is another one. ``joint`` tells that it is the number of
    another moving joint, ``per_other`` that it counts the joint's motion per that of this other one: between a slide
    and a revolute joint it may be written in rad/m or m/rad, in which it is taken. ``tried`` are the values at which a
    search for an unknown one begins, in units of the joint's top speed where ``relative`` says "speed", of its rotor's
    inertia where it says "rotor", of half the range it moves through, from its middle, where it says "position", of
    that half or of the shape's unit, whichever is less, where it says "way", and ``within`` are ends between which it
    goes on from there in geometric steps; where ``whole`` nothing between whole numbers is tried, and where
    ``several`` every whole number up to that one. Where ``exact`` what fits better between two whole numbers is
    another effect. Of a ``scale`` any value will do where none is known: others count in units of it. One that is
    ``nonzero`` may have either sign.
    """

    name: str
    unit: str
    meaning: str
    lower: float | None = None
    upper: float | None = None
    default: sympy.Expr | None = None
    prismatic: str | None = None
    joint: bool = False
    per_other: bool = False
    tried: tuple[float, ...] = ()
    within: tuple[float, float] | None = None
    relative: str = ""
    whole: bool = False
    several: int = 0
    exact: bool = False
    scale: bool = False
    nonzero: bool = False

    def unit_on(self, joint: Joint) -> str:
        """The unit on this joint: ``prismatic``, if there is one, on a prismatic joint, else ``unit``."""
        return self.prismatic if self.prismatic and joint.sigma == PRISMATIC else self.unit


@dataclass(frozen=True)
class State:
    """A state inside an effect, such as the deflection of a bristle: its name is ``stem`` and the joint's number.

    ``units`` are those on a revolute and on a prismatic joint.
    """

    stem: str
    units: tuple[str, str]
    meaning: str

    def unit(self, joint: Joint) -> str:
        """The unit on this joint, which is revolute or prismatic."""
        return self.units[joint.sigma == PRISMATIC]


@dataclass(frozen=True)
class Site:
    """Where an effect sits: the joint, its motion as symbols, and the shape values [SI].

    ``elongation`` is the flexible coordinate q_e of the joint (report eq. 7), used by elastic effects only. ``ratios``
    is the row of the joint's motor in N, by joint number, for effects that need it: its position in terms of theirs.
    """

    joint: Joint
    values: Mapping[str, sympy.Expr] = field(default_factory=dict)
    ratios: Mapping[int, sympy.Rational] = field(default_factory=dict)

    @property
    def q(self) -> sympy.Symbol:
        """Position of the joint [rad, m]. On an elastic joint it is q_a of the link, for effects on the motor side q_m
        (report eq. 7).
        """
        return self.joint.variable

    @property
    def qd(self) -> sympy.Symbol:
        """Speed of the joint [rad/s, m/s], of the same side as ``q``."""
        return sympy.Symbol(f"qd{self.joint.number}", real=True)

    @property
    def qdd(self) -> sympy.Symbol:
        """Acceleration of the joint [rad/s2, m/s2], of the same side as ``q``."""
        return sympy.Symbol(f"qdd{self.joint.number}", real=True)

    @property
    def elongation(self) -> sympy.Symbol:
        """Elongation q_e = q_a - q_m of an elastic joint [rad, m], from the motor to the link (report eq. 7)."""
        return sympy.Symbol(f"qe{self.joint.number}", real=True)

    @property
    def load(self) -> sympy.Symbol:
        """Load of the drive: torque of bodies, rotors, balancers, springs, ripple, offsets, and the tool's wrench."""
        return sympy.Symbol(f"load{self.joint.number}", real=True)

    @property
    def warmth(self) -> sympy.Symbol:
        """How warm the joint's drive is: 0 where the parameters hold as they are stated, 1 where the drift is whole."""
        return sympy.Symbol(f"warmth{self.joint.number}", real=True)

    def state(self, stem: str) -> sympy.Symbol:
        """One of the effect's own states."""
        return sympy.Symbol(f"{stem}{self.joint.number}", real=True)

    @property
    def motor(self) -> sympy.Expr:
        """Position of the joint's motor [rad]."""
        return sympy.Add(*(ratio * sympy.Symbol(f"q{j}", real=True) for j, ratio in self.ratios.items()))

    def on_joint(self, torque: sympy.Expr) -> Column:
        """The column of a torque that acts on this joint alone."""
        return {self.joint.number: torque}

    def on_motor(self, torque: sympy.Expr) -> Column:
        """The column of a torque of the motor, times its gear ratio: coupled joints share it by equal power."""
        own = self.ratios[self.joint.number]
        return {j: torque * ratio / own for j, ratio in self.ratios.items()}


@dataclass(frozen=True)
class Positive:
    """A ``length`` [m] that must stay positive: the ``value`` to blame where it does not, what is wrong with it, and
    what is expected instead. No machine leaves less than the part ``room`` of that value.
    """

    value: str
    length: sympy.Expr
    problem: str
    expected: str
    room: float = 0.0


@dataclass(frozen=True)
class Effect:
    """A physical effect.

    ``columns`` returns one column per linear parameter, in the order of ``parameters``. ``kinetic_energy`` and
    ``potential_energy`` return the energy per unit of each parameter [J/unit], where the effect stores any;
    a potential is zero at q = 0 where it is finite there. ``positive`` returns the lengths that must stay positive over
    the joint's limits, ``extremes`` the positions between two others, and these, among which each length has its least
    value. ``observables`` names further outputs worth emitting, each an expression that may contain the parameters'
    symbols (named by their stems), with its unit. ``needs`` says what the columns are made of: q, qd, qdd, qe
    (elongation), motor (its position; the robot needs drives), load, warmth, state.
    ``rates`` are the time derivatives of ``states``, in their order. ``drive_train`` effects sit on the motor side of
    an elastic joint. ``on_link`` effects act on the link past the transmission, whose load they are part of; they
    depend on q alone. What reads the load is proportional to |load - rotor qdd|, ``rotor`` a shape value, 0 without it.
    ``dissipates`` tells that the effect never gives power to the robot while its parameters are not below their bounds.
    ``kinds`` are the kinds of joint (sigma) it can sit on. ``rank`` orders the parameters of one joint. ``occurs`` is
    how many robots have it (``EVERYWHERE``, ``OFTEN``), ``role`` what it is there for (``BALANCER``, ``SPRING``), both
    empty of most effects. ``resembles`` maps ids of effects that look alike in measurements to what tells them apart.
    """

    id: str
    title: str
    parameters: tuple[LinearParameter, ...]
    columns: Callable[[Site], tuple[Column, ...]]
    needs: tuple[str, ...]
    sign_convention: str
    source: str
    assumptions: str = ""
    shapes: tuple[Shape, ...] = ()
    kinetic_energy: Callable[[Site], tuple[sympy.Expr, ...]] | None = None
    potential_energy: Callable[[Site], tuple[sympy.Expr, ...]] | None = None
    positive: Callable[[Site], tuple[Positive, ...]] | None = None
    extremes: Callable[[Site, sympy.Expr, sympy.Expr], list[sympy.Expr]] | None = None
    observables: Callable[[Site], Mapping[str, tuple[sympy.Expr, str, str]]] | None = None
    states: tuple[State, ...] = ()
    rates: Callable[[Site], tuple[sympy.Expr, ...]] | None = None
    drive_train: bool = False
    on_link: bool = False
    dissipates: bool = False
    kinds: tuple[int, ...] = (REVOLUTE, PRISMATIC)
    rank: int = 100
    occurs: str = ""
    role: str = ""
    resembles: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Raises ValueError for a drive train's effect that needs what the motor of an elastic joint does not have."""
        absent = [need for need in self.needs if need not in OF_MOTOR_SIDE]
        if self.drive_train and absent:
            known = ", ".join(OF_MOTOR_SIDE)
            raise ValueError(f"drive-train effect {self.id} needs {', '.join(absent)}, expected some of {known}")

    @property
    def loads(self) -> bool:
        """Whether its torque is a part of the load of the drive: what stores energy, as weight does, and offsets."""
        return self.potential_energy is not None or not self.needs


def accelerates(column: Column) -> bool:
    """Whether the torque of a parameter depends on accelerations."""
    return any(symbol.name.startswith("qdd") for torque in column.values() for symbol in torque.free_symbols)
