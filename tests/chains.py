"""Robots made up for the tests: the report's structure with any lengths, random chains and trees, elastic chains."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from random import Random

import sympy
from sympy import Integer, Rational, pi

from generator.effects.effect import Effect, Shape
from generator.effects.library import library
from generator.errors import Place
from generator.robot.description import (
    FIXED,
    PRISMATIC,
    REVOLUTE,
    Drives,
    EffectUse,
    Joint,
    Length,
    Robot,
)
from generator.units import Quantity

#: Free fall in the world frame, exact.
STANDARD_GRAVITY = (Integer(0), Integer(0), Rational(-981, 100))

_RIGHT_ANGLES = [Integer(0), Integer(0), pi / 2, pi / 2, -pi / 2, pi]
_ODD_ANGLES = [pi / 3, -pi / 4, Rational(7, 10), -Rational(13, 10)]
_LENGTHS = [Integer(0), Integer(0), Rational(1, 2), -Rational(3, 10), Rational(17, 20)]


def symbol(name: str) -> sympy.Symbol:
    """A joint variable or a length as it stands in a description."""
    return sympy.Symbol(name, real=True)


def joint(
    number: int,
    sigma: int,
    alpha: sympy.Expr = Integer(0),
    d: sympy.Expr = Integer(0),
    theta: sympy.Expr = Integer(0),
    r: sympy.Expr = Integer(0),
    *,
    antecedent: int | None = None,
    gamma: sympy.Expr = Integer(0),
    b: sympy.Expr = Integer(0),
    tool: bool = False,
) -> Joint:
    """A joint whose ``theta`` (revolute) or ``r`` (prismatic) is given at q = 0."""
    variable = symbol(f"q{number}")
    theta = theta + variable if sigma == REVOLUTE else theta
    r = r + variable if sigma == PRISMATIC else r
    carrier = number - 1 if antecedent is None else antecedent
    return Joint(number, carrier, sigma, alpha, d, theta, r, gamma, b, tool=tool)


def robot(
    name: str,
    joints: Sequence[Joint],
    *,
    gravity: tuple[sympy.Expr, sympy.Expr, sympy.Expr] = STANDARD_GRAVITY,
    base: sympy.ImmutableMatrix | None = None,
    lengths: Sequence[Length] = (),
    effects: Sequence[EffectUse] = (),
    drives: Drives | None = None,
    flexible: Sequence[int] = (),
) -> Robot:
    """A robot without parameter values."""
    return Robot(
        name=name,
        description="made up for a test",
        source="tests/chains.py",
        gravity=gravity,
        base=sympy.eye(4).as_immutable() if base is None else base,
        lengths=tuple(lengths),
        joints=tuple(joints),
        effects=tuple(effects),
        drives=drives,
        flexible=tuple(flexible),
        parameter_sets={},
        place=Place("tests/chains.py"),
        digest="0" * 64,
    )


def on_all_joints(joints: Sequence[Joint], *effects: str) -> tuple[EffectUse, ...]:
    """Effects without fixed values on every moving joint."""
    moving = tuple(j.number for j in joints if j.sigma != FIXED)
    return tuple(EffectUse(effect, moving) for effect in effects)


DRIVE_TRAIN = ("rotor_inertia", "viscous_friction", "coulomb_friction", "offset")


# -- the report's robots ----------------------------------------------------------------------------------------------


def anthropomorphic(name: str, lengths: Mapping[str, sympy.Expr], *effects: EffectUse) -> Robot:
    """The structure of report Table 4 with lengths d2, d3, d4, rl1, rl4, rl6."""
    d2, d3, d4, rl1, rl4, rl6 = (symbol(length) for length in ("d2", "d3", "d4", "rl1", "rl4", "rl6"))
    joints = (
        joint(1, REVOLUTE, pi, r=rl1),
        joint(2, REVOLUTE, pi / 2, d2),
        joint(3, REVOLUTE, d=d3, theta=pi / 2),
        joint(4, REVOLUTE, -pi / 2, d4, r=rl4),
        joint(5, REVOLUTE, pi / 2),
        joint(6, REVOLUTE, -pi / 2, theta=-pi / 2, r=rl6),
        joint(7, FIXED, tool=True),
    )
    named = [Length(length, value) for length, value in lengths.items()]
    return robot(name, joints, lengths=named, effects=(*on_all_joints(joints, *DRIVE_TRAIN), *effects))


def random_anthropomorphic(draw: Random) -> Robot:
    """Report Table 4 with random lengths, none of them zero."""
    lengths = {
        name: Rational(draw.choice((-1, 1)) * draw.randint(50, 1500), 1000)
        for name in ("d2", "d3", "d4", "rl1", "rl4", "rl6")
    }
    return anthropomorphic("anthropomorphic", lengths)


# -- elastic chains ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class ElasticChain:
    """A robot in which each elastic joint is two joints, as in report Table 5.

    ``motor`` and ``link`` map the numbers of the original joints to those of this chain: the joint that the motor
    turns, and the frame that carries the body. ``spring`` maps an elastic joint to its spring's joint.
    """

    robot: Robot
    motor: Mapping[int, int]
    link: Mapping[int, int]
    spring: Mapping[int, int]


def elastic_chain(rigid: Robot, effects: Sequence[EffectUse] = ()) -> ElasticChain:
    """Report Table 5 from Table 4: before each elastic joint's body comes a massless one that its motor moves.

    The spring's joint follows on the same axis with all its own geometry zero.
    """
    joints: list[Joint] = []
    motor: dict[int, int] = {}
    link: dict[int, int] = {0: 0}
    spring: dict[int, int] = {}
    for original in rigid.joints:
        number = len(joints) + 1
        variable = {original.variable: symbol(f"q{number}")}
        carrier = link[original.antecedent]
        theta, r = original.theta.subs(variable), original.r.subs(variable)
        joints.append(replace(original, number=number, antecedent=carrier, theta=theta, r=r))
        motor[original.number] = link[original.number] = number
        if original.number in rigid.flexible:
            joints.append(joint(number + 1, original.sigma))
            spring[original.number] = link[original.number] = number + 1
    chain = replace(rigid, name=f"{rigid.name}_elastic", joints=tuple(joints), effects=tuple(effects), flexible=())
    return ElasticChain(replace(chain, drives=None), motor, link, spring)


# -- random chains ----------------------------------------------------------------------------------------------------


def random_robot(draw: Random, most: int = 5) -> Robot:
    """Any chain or tree of one to ``most`` frames with bodies, and most often a tool frame.

    All kinds of joints, right angles and an odd one, lengths that are zero, numbers or symbols, any base and gravity.
    """
    count = draw.randint(1, most)
    sigmas = [draw.choice((REVOLUTE, REVOLUTE, REVOLUTE, PRISMATIC, FIXED)) for _ in range(count)]
    if all(sigma == FIXED for sigma in sigmas):
        sigmas[-1] = REVOLUTE
    lengths = [Length(f"a{k}", Rational(draw.randint(1, 30), 20), symbolic=draw.random() < 0.5) for k in (1, 2)]
    branching = draw.random() < 0.35
    choices = _Choices(
        angles=[*_RIGHT_ANGLES, draw.choice(_ODD_ANGLES)] if draw.random() < 0.6 else _RIGHT_ANGLES,
        lengths=[*_LENGTHS, *(symbol(length.name) for length in lengths)],
        branching=branching,
    )
    joints = [_random_joint(draw, number, sigma, choices) for number, sigma in enumerate(sigmas, start=1)]
    if draw.random() < 0.7:
        joints.append(_random_joint(draw, count + 1, FIXED, choices, tool=True))
    moving = [j for j in joints if j.sigma != FIXED]
    made = robot(
        "random",
        joints,
        gravity=_random_gravity(draw),
        base=_random_pose(draw),
        lengths=lengths,
        effects=_random_effects(draw, moving),
        drives=_random_drives(draw, len(moving)),
        flexible=[j.number for j in moving if draw.random() < 0.5],
    )
    made = replace(made, effects=(*made.effects, *more_effects(draw, made, 0.15)))
    if not any(use.effect == "spring_balancer" for use in made.effects):
        return made
    # With some lengths the torque of a spring's stiffness is that of a weight, which is refused where they are symbols.
    return replace(made, lengths=tuple(replace(one, symbolic=False) for one in made.lengths))


def random_chain(draw: Random, count: int) -> Robot:
    """A serial chain of ``count`` bodies on revolute and some prismatic joints, with drive trains."""
    choices = _Choices(_RIGHT_ANGLES, _LENGTHS, branching=False)
    sigmas = [draw.choice((REVOLUTE,) * 5 + (PRISMATIC,)) for _ in range(count)]
    joints = [_random_joint(draw, number, sigma, choices) for number, sigma in enumerate(sigmas, start=1)]
    return robot(f"chain{count}", joints, effects=on_all_joints(joints, *DRIVE_TRAIN))


@dataclass(frozen=True)
class _Choices:
    """What the joints of a random robot are made of."""

    angles: Sequence[sympy.Expr]
    lengths: Sequence[sympy.Expr]
    branching: bool


def _random_joint(draw: Random, number: int, sigma: int, choices: _Choices, tool: bool = False) -> Joint:
    antecedent = draw.randint(0, number - 1) if choices.branching else number - 1
    alpha, theta, gamma = (draw.choice(choices.angles) for _ in range(3))
    d, r, b = (draw.choice(choices.lengths) for _ in range(3))
    if antecedent == number - 1:
        gamma, b = Integer(0), Integer(0)
    return joint(number, sigma, alpha, d, theta, r, antecedent=antecedent, gamma=gamma, b=b, tool=tool)


def _random_gravity(draw: Random) -> tuple[sympy.Expr, sympy.Expr, sympy.Expr]:
    if draw.random() < 0.5:
        return STANDARD_GRAVITY
    x, y, z = (Rational(draw.randint(-98, 98), 10) for _ in range(3))
    return x, y, z


def _random_pose(draw: Random) -> sympy.ImmutableMatrix:
    """A rotation with rational entries (from a quaternion of integers) and a position."""
    if draw.random() < 0.4:
        return sympy.eye(4).as_immutable()
    w, x, y, z = draw.choice([(1, 0, 0, 0), (0, 1, 0, 0), (1, 1, 0, 0), (1, 2, -1, 3), (2, -1, 1, 1)])
    square = w * w + x * x + y * y + z * z
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    position = [Rational(draw.randint(-10, 10), 4) for _ in range(3)]
    top = [[Rational(entry, square) for entry in row] + [p] for row, p in zip(rows, position, strict=True)]
    return sympy.ImmutableMatrix([*top, [0, 0, 0, 1]])


def _random_effects(draw: Random, moving: Sequence[Joint]) -> list[EffectUse]:
    uses = []
    for effect in DRIVE_TRAIN:
        carried = tuple(j.number for j in moving if draw.random() < 0.7)
        if carried:
            uses.append(EffectUse(effect, carried))
    turning = [j for j in moving if j.sigma == REVOLUTE]
    if turning and draw.random() < 0.5:
        uses.append(draw.choice([gas_balancer, spring_balancer])((draw.choice(turning).number,), draw))
    return uses


def every_effect() -> Robot:
    """Two turning joints and a slide, coupled motors, an elastic joint: with every effect of the library somewhere."""
    draw = Random(7)
    joints = (
        joint(1, REVOLUTE, r=Rational(1, 2)),
        joint(2, REVOLUTE, pi / 3, d=Rational(3, 10)),
        joint(3, PRISMATIC, -pi / 2, d=Rational(1, 4)),
        joint(4, FIXED, r=Rational(1, 5), tool=True),
    )
    ratios = (Integer(60), Rational(-165, 4), 25 * pi)
    drives = Drives(
        ratios,
        (
            (ratios[0], Integer(0), Integer(0)),
            (Rational(5, 4), ratios[1], Integer(0)),
            (Integer(0), Integer(0), ratios[2]),
        ),
        {"cold": (Fraction(1), Fraction(6, 5), Fraction(4, 5))},
        "cold",
        (Fraction(-3, 50), Fraction(0), Fraction(1, 100)),
    )
    balancers = (spring_balancer((1,), draw), gas_balancer((2,), draw))
    made = robot("every_effect", joints, effects=balancers, drives=drives, flexible=(2,))
    loose = EffectUse("joint_elasticity", (2,), {"gap": Quantity(Rational(1, 100), "rad")})
    return replace(made, effects=(*balancers, *more_effects(draw, made, 1.0), loose))


def any_effect(draw: Random, effect: Effect, joint: Joint, others: Sequence[int]) -> EffectUse:
    """An effect of the library on one joint, its values within their bounds."""
    values = {
        shape.name: Quantity(_within(draw, shape), shape.unit_on(joint))
        for shape in effect.shapes
        if shape.default is None or draw.random() < 0.5
    }
    values |= {shape.name: Quantity(Integer(draw.choice(others)), "1") for shape in effect.shapes if shape.joint}
    return EffectUse(effect.id, (joint.number,), values)


#: Dry friction that with an offset is another one's, and friction that tells them apart: of even and of odd joints.
_APART = ("asymmetric_coulomb", "load_friction")


def more_effects(draw: Random, robot: Robot, often: float) -> tuple[EffectUse, ...]:
    """Effects that a joint of ``robot`` has not yet, balancers apart, each with probability ``often``."""
    there = {(use.effect, number) for use in robot.effects for number in use.joints}
    return tuple(
        any_effect(draw, effect, joint, [other.number for other in robot.moving if other is not joint])
        for effect in library().values()
        for joint in robot.moving
        if "qe" not in effect.needs
        and joint.sigma in effect.kinds
        and (robot.drives or "motor" not in effect.needs)
        and (effect.id, joint.number) not in there
        and not effect.observables
        and (_may_turn_with_another(robot) or not any(shape.joint for shape in effect.shapes))
        and (effect.id not in _APART or joint.number % 2 == _APART.index(effect.id))
        and draw.random() < often
    )


def _may_turn_with_another(robot: Robot) -> bool:
    """Where a second joint moves; its groupings with the bodies must not depend on symbolic lengths."""
    return len(robot.moving) > 1 and not any(length.symbolic for length in robot.lengths)


def _within(draw: Random, shape: Shape) -> sympy.Expr:
    lower = Fraction(-1) if shape.lower is None else Fraction(shape.lower)
    upper = lower + 3 if shape.upper is None else Fraction(shape.upper)
    value = lower + (upper - lower) * Fraction(draw.randint(1, 19), 20)
    return Rational(value.numerator, value.denominator)


def _crank(draw: Random) -> dict[str, Quantity]:
    d21, d22 = Rational(draw.randint(50, 90), 100), Rational(draw.randint(10, 30), 100)
    phi = Rational(draw.randint(-30, 30), 10)
    return {"d21": Quantity(d21, "m"), "d22": Quantity(d22, "m"), "phi": Quantity(phi, "rad")}


def spring_balancer(joints: tuple[int, ...], draw: Random) -> EffectUse:
    """A spring balancer of random size."""
    return EffectUse("spring_balancer", joints, _crank(draw))


def gas_balancer(joints: tuple[int, ...], draw: Random) -> EffectUse:
    """A gas balancer of random size, isothermal or not, whose chamber never closes."""
    exponent = Quantity(draw.choice((Integer(1), Rational(6, 5), Rational(7, 5))), "1")
    values = {**_crank(draw), "l0": Quantity(Rational(4, 5), "m"), "exponent": exponent}
    return EffectUse("gas_balancer", joints, values)


def _random_drives(draw: Random, count: int) -> Drives | None:
    if draw.random() < 0.4:
        return None
    ratios = tuple(Rational(draw.choice((-1, 1)) * draw.randint(50, 3000), draw.randint(1, 20)) for _ in range(count))
    coupling = tuple(
        tuple(
            ratios[i] if i == k else Rational(draw.randint(-5, 5), 3) if k < i and draw.random() < 0.4 else Integer(0)
            for k in range(count)
        )
        for i in range(count)
    )
    constants = tuple(Fraction(draw.randint(50, 300), 100) for _ in range(count))
    return Drives(ratios, coupling, {"cold": constants}, "cold")
