"""The geometry of a robot as numbers: each frame's pose in its antecedent, and what carries it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal

import numpy as np
import sympy

from generator.reference.arithmetic import Array, cosine, decimals, exact, sine
from generator.robot.description import FIXED, REVOLUTE, Joint, Robot

#: d/dq of a rotation about z and of a translation along z, at q = 0, in homogeneous coordinates.
TURN = decimals([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]])
SLIDE = decimals([[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0]])


@dataclass(frozen=True)
class Link:
    """Frame ``number``: its ``rest`` pose (4 x 4) in frame ``antecedent`` at q = 0 and its joint's ``rate`` there.

    ``coordinate`` is the index of its variable in q, None if fixed; ``carriers`` are the coordinates that move it.
    """

    number: int
    antecedent: int
    rest: Array
    rate: Array | None
    coordinate: int | None
    carriers: tuple[int, ...]

    def pose(self, q: Array) -> Array:
        """Pose of the frame in its antecedent (4 x 4)."""
        if self.coordinate is None:
            return self.rest
        variable = q[self.coordinate]
        return self.rest @ (rotation_z(variable) if self.rate is TURN else translation(0, 0, variable))


@dataclass(frozen=True)
class Chain:
    """Links in order, antecedents first; ``base`` pose (4 x 4) of frame 0 and ``gravity`` [m/s2] in the world frame.

    ``tool`` is the number of the frame where wrenches act; ``dof`` the size of q.
    """

    links: tuple[Link, ...]
    base: Array
    gravity: Array
    tool: int
    dof: int


def build(robot: Robot, values: Mapping[str, Decimal]) -> Chain:
    """The chain of ``robot``; a length is taken from ``values`` if it is named there, else nominal."""
    lengths = {
        sympy.Symbol(length.name, real=True): values.get(length.name, exact(length.value)) for length in robot.lengths
    }
    links: list[Link] = []
    coordinate = 0
    for joint in robot.joints:
        carriers = links[joint.antecedent - 1].carriers if joint.antecedent else ()
        rest = _rest(joint, lengths)
        if joint.sigma == FIXED:
            links.append(Link(joint.number, joint.antecedent, rest, None, None, carriers))
            continue
        rate = TURN if joint.sigma == REVOLUTE else SLIDE
        links.append(Link(joint.number, joint.antecedent, rest, rate, coordinate, (*carriers, coordinate)))
        coordinate += 1
    base = _numbers(robot.base.tolist(), lengths)
    return Chain(tuple(links), base, _numbers([list(robot.gravity)], lengths)[0], robot.tool.number, coordinate)


def _rest(joint: Joint, lengths: Mapping[sympy.Symbol, Decimal]) -> Array:
    """Rot(z, gamma) Trans(z, b) Rot(x, alpha) Trans(x, d) Rot(z, theta) Trans(z, r) at q = 0 (report eq. 1)."""
    variable = joint.variable
    theta = joint.theta - variable if joint.sigma == REVOLUTE else joint.theta
    r = joint.r - variable if joint.sigma not in (REVOLUTE, FIXED) else joint.r
    gamma, b, alpha, d, theta, r = _numbers([[joint.gamma, joint.b, joint.alpha, joint.d, theta, r]], lengths)[0]
    before = rotation_z(gamma) @ translation(0, 0, b) @ rotation_x(alpha) @ translation(d, 0, 0)
    return before @ rotation_z(theta) @ translation(0, 0, r)


def _numbers(rows: list[list[sympy.Expr]], lengths: Mapping[sympy.Symbol, Decimal]) -> Array:
    return decimals([[_number(entry, lengths) for entry in row] for row in rows])


def _number(expression: sympy.Expr, lengths: Mapping[sympy.Symbol, Decimal]) -> Decimal:
    """The value of an expression in the lengths; raises TypeError where a joint variable is left in it."""
    if expression in lengths:
        return lengths[expression]
    needed = expression.free_symbols & lengths.keys()
    if not needed:
        return exact(expression)
    return exact(expression.subs({symbol: sympy.Rational(*lengths[symbol].as_integer_ratio()) for symbol in needed}))


def rotation_z(angle: Decimal) -> Array:
    """Homogeneous matrix (4 x 4) of the right-handed rotation by ``angle`` [rad] about z."""
    c, s = cosine(angle), sine(angle)
    return decimals([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def rotation_x(angle: Decimal) -> Array:
    """Homogeneous matrix (4 x 4) of the right-handed rotation by ``angle`` [rad] about x."""
    c, s = cosine(angle), sine(angle)
    return decimals([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])


def translation(x: Decimal | int, y: Decimal | int, z: Decimal | int) -> Array:
    """Homogeneous matrix (4 x 4) of the translation by x, y, z [m]."""
    return decimals([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]])


def inverse(pose: Array) -> Array:
    """The inverse of a rigid motion (4 x 4)."""
    rotation, position = pose[:3, :3], pose[:3, 3]
    top = np.hstack([rotation.T, -(rotation.T @ position).reshape(3, 1)])
    return np.vstack([top, pose[3:]])
