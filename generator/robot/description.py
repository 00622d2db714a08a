"""A robot as plain, frozen data: what its file says, exactly, and nothing derived from it.

Expressions are exact sympy expressions (rationals, pi, elementary functions of them). In a joint's geometry the free
symbols are the named lengths and, in ``theta`` (revolute) or ``r`` (prismatic), the joint's own variable ``q<j>``.
SI units throughout: m, rad, s, kg, N, N m, A; a prismatic joint has m for rad and N for N m.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction

import sympy

from generator.errors import NOWHERE, Place
from generator.units import Quantity

REVOLUTE, PRISMATIC, FIXED = 0, 1, 2


@dataclass(frozen=True)
class Length:
    """A named length [m] or angle [rad] of the geometry.

    ``value`` is exact. A ``symbolic`` length stays a parameter of the generated code; ``value`` is then its nominal
    value, used for numbers in the review and for checks.
    """

    name: str
    value: sympy.Expr
    unit: str = "m"
    symbolic: bool = False
    place: Place = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Joint:
    """Joint and frame ``number`` in modified Denavit-Hartenberg notation (Khalil and Kleinfinger 1986).

    Frame ``number`` follows from frame ``antecedent`` by
    Rot(z, gamma) Trans(z, b) Rot(x, alpha) Trans(x, d) Rot(z, theta) Trans(z, r); gamma = b = 0 on a serial chain.
    ``sigma`` is 0 revolute, 1 prismatic, 2 fixed. A ``tool`` frame is fixed, carries no body of its own, and is where
    wrenches act and payloads sit. Limits are None where the file gives none; those of speed [rad/s, m/s], acceleration
    [rad/s2, m/s2] and torque [N m, N] hold either way.
    """

    number: int
    antecedent: int
    sigma: int
    alpha: sympy.Expr
    d: sympy.Expr
    theta: sympy.Expr
    r: sympy.Expr
    gamma: sympy.Expr = sympy.S.Zero
    b: sympy.Expr = sympy.S.Zero
    lower: sympy.Expr | None = None
    upper: sympy.Expr | None = None
    speed_limit: sympy.Expr | None = None
    acceleration_limit: sympy.Expr | None = None
    torque_limit: sympy.Expr | None = None
    tool: bool = False
    label: str = ""

    def at(self, angles: Mapping[sympy.Symbol, sympy.Expr]) -> Joint:
        """The joint with named ``angles`` written as what they are [rad]."""
        alpha, theta, gamma = (angle.xreplace(angles) for angle in (self.alpha, self.theta, self.gamma))
        return replace(self, alpha=alpha, theta=theta, gamma=gamma)

    @property
    def variable(self) -> sympy.Symbol:
        """The joint variable ``q<number>``."""
        return sympy.Symbol(f"q{self.number}", real=True)

    @property
    def limits(self) -> tuple[float, float] | None:
        """The lower and the upper limit of its variable [rad, m], of which no file gives one alone; None without."""
        return None if self.lower is None or self.upper is None else (float(self.lower), float(self.upper))

    @property
    def position_unit(self) -> str:
        """Of its variable; speeds and accelerations are by s and s2."""
        return "m" if self.sigma == PRISMATIC else "rad"

    @property
    def torque_unit(self) -> str:
        """Of what acts along it."""
        return "N" if self.sigma == PRISMATIC else "N m"

    @property
    def ratio_unit(self) -> str:
        """Of its gear ratio, which a motor's rad by rad has none of."""
        return "rad/m" if self.sigma == PRISMATIC else "1"

    @property
    def gain_unit(self) -> str:
        """Of what acts along it by a motor's current."""
        return f"{self.torque_unit}/A"

    @property
    def stiffness_unit(self) -> str:
        """Of a spring along it."""
        return f"{self.torque_unit}/{self.position_unit}"

    @property
    def inertia_unit(self) -> str:
        """Of what moves with it."""
        return "kg" if self.sigma == PRISMATIC else "kg m2"


@dataclass(frozen=True)
class EffectUse:
    """An effect of the library applied to joints; ``values`` are its fixed shape values by name, exact, in SI units.

    Whether the library has the effect and its values is for the library to say: ``place`` and each value's place tell
    where the file asks for them.
    """

    effect: str
    joints: tuple[int, ...]
    values: Mapping[str, Quantity] = field(default_factory=dict)
    place: Place = NOWHERE


@dataclass(frozen=True)
class Drives:
    """Drive train: motor speed = N joint speed (report eq. 14-15), exact: rationals, with pi where a slide is driven.

    ``coupling`` is the matrix N, row i the motor i, column j the moving joint j. ``torque_constants`` [N m/A] by name
    ("cold", "warm"), one per motor; ``torque_constant`` names the one in use. ``torque_drift`` is the relative change
    of each constant at warmth 1, empty where there is none.
    """

    ratios: tuple[sympy.Expr, ...]
    coupling: tuple[tuple[sympy.Expr, ...], ...]
    torque_constants: Mapping[str, tuple[Fraction, ...]] = field(default_factory=dict)
    torque_constant: str = ""
    torque_drift: tuple[Fraction, ...] = ()


@dataclass(frozen=True)
class Signals:
    """How recorded signals differ from the model's, one exact value per moving joint; empty where they do not.

    True position = recorded + ``position_offset`` [rad, m]; true motor torque = recorded times ``torque_gain``. What is
    recorded as motor torque or current was true ``torque_delay`` [s] before (it will be, where that is negative), as
    link-side position ``link_delay`` [s] before. Currents saturate at ``current_limit`` [A] either way. The warmth of a
    drive is 1 - exp(-t/``warm_up_time``) [s], or its temperature's rise over ``warm_rise`` [K], or follows the square
    of the recorded motor torque over ``warm_torque`` [N m, N] with that time constant; of these four, 1e6 or
    more means that it is not stated. Nothing of it is in the generated functions.
    """

    position_offset: tuple[sympy.Expr, ...] = ()
    torque_gain: tuple[sympy.Expr, ...] = ()
    torque_delay: tuple[sympy.Expr, ...] = ()
    link_delay: tuple[sympy.Expr, ...] = ()
    current_limit: tuple[sympy.Expr, ...] = ()
    warm_up_time: tuple[sympy.Expr, ...] = ()
    warm_rise: tuple[sympy.Expr, ...] = ()
    warm_torque: tuple[sympy.Expr, ...] = ()


@dataclass(frozen=True)
class ParameterValue:
    """A value of a parameter [``unit``, SI], its relative standard deviation [%] if known, and where it comes from."""

    value: float
    unit: str
    relative_std: float | None = None
    source: str = ""
    note: str = ""
    place: Place = NOWHERE


@dataclass(frozen=True)
class ParameterSet:
    """A named set of parameter values; names as in the generated parameter order, base or standard.

    ``other_values`` are what the same source gives beside parameters of the model: drive gains, a payload, a sensor's
    offset. Their names are free.
    """

    name: str
    description: str
    source: str
    values: Mapping[str, ParameterValue]
    other_values: Mapping[str, ParameterValue] = field(default_factory=dict)
    place: Place = NOWHERE


@dataclass(frozen=True)
class Robot:
    """Everything that a robot file says.

    ``gravity`` is the acceleration of free fall [m/s2] in the world frame; ``base`` the 4 x 4 pose of frame 0 in the
    world frame (exact). ``joints`` are in order, antecedents first, numbered 1..len. ``flexible`` lists the numbers of
    the joints whose drive train is elastic. ``digest`` is a SHA-256 of what the file says, comments and layout aside.
    """

    name: str
    description: str
    source: str
    gravity: tuple[sympy.Expr, sympy.Expr, sympy.Expr]
    base: sympy.ImmutableMatrix
    lengths: tuple[Length, ...]
    joints: tuple[Joint, ...]
    effects: tuple[EffectUse, ...]
    drives: Drives | None
    flexible: tuple[int, ...]
    parameter_sets: Mapping[str, ParameterSet]
    place: Place
    digest: str
    signals: Signals = Signals()

    @property
    def moving(self) -> tuple[Joint, ...]:
        """The joints that move, in order: element i of q belongs to ``moving[i]``."""
        return tuple(joint for joint in self.joints if joint.sigma != FIXED)

    @property
    def geometry(self) -> dict[sympy.Symbol, sympy.Expr]:
        """Values of all named lengths [m] and angles [rad] by their symbols, nominal ones where they stay symbolic."""
        return {sympy.Symbol(one.name, real=True): one.value for one in self.lengths}

    @property
    def constant_angles(self) -> dict[sympy.Symbol, sympy.Expr]:
        """Named angles [rad] that are no parameters of the code, by their symbols."""
        named = [one for one in self.lengths if one.unit == "rad" and not one.symbolic]
        return {sympy.Symbol(one.name, real=True): one.value for one in named}

    @property
    def numbers(self) -> tuple[int, ...]:
        """Those of the joints that move, in order."""
        return tuple(joint.number for joint in self.moving)

    @property
    def bodies(self) -> tuple[Joint, ...]:
        """The frames that carry a body with ten standard inertial parameters: all but the tool frames."""
        return tuple(joint for joint in self.joints if not joint.tool)

    @property
    def tool(self) -> Joint:
        """The frame where wrenches act and payloads sit: the file's tool frame, else the last frame."""
        return next((joint for joint in self.joints if joint.tool), self.joints[-1])

    def has(self, effect: str, number: int) -> bool:
        """Whether the file asks for an effect on joint ``number``."""
        return any(use.effect == effect and number in use.joints for use in self.effects)

    def use(self, effect: str, number: int) -> EffectUse:
        """Where the file asks for an effect on joint ``number``."""
        return next(use for use in self.effects if use.effect == effect and number in use.joints)

    def antecedent(self, joint: Joint) -> Joint | None:
        """The joint that carries ``joint``; None for the base."""
        return self.joints[joint.antecedent - 1] if joint.antecedent else None
