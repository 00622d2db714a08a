"""Frames of the chain in modified Denavit-Hartenberg notation (report eq. 1), as nodes of the program."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import sympy

from generator.robot.description import FIXED, PRISMATIC, REVOLUTE, Joint, Robot
from generator.symbolic.lowering import lower
from generator.symbolic.statements import Node, Program
from generator.symbolic.vectors import Array, array, zeros


@dataclass(frozen=True)
class Frame:
    """Frame j of the chain.

    ``rotation`` (3 x 3) holds the axes of frame j in frame a(j), ``position`` (3) the origin O_j in frame a(j) [m];
    ``entry`` (3 x 3) is the part of the rotation that comes before the joint's angle: Rot(z, gamma) Rot(x, alpha).
    ``coordinate`` is the index of the joint's variable in q, None for a fixed frame. ``parent`` is the antecedent's
    frame, None when that is frame 0.
    """

    joint: Joint
    entry: Array
    rotation: Array
    position: Array
    coordinate: int | None
    parent: Frame | None

    @property
    def number(self) -> int:
        """Number j of the joint and its frame, from 1."""
        return self.joint.number

    @property
    def revolute(self) -> bool:
        """Whether the joint turns about its axis z_j."""
        return self.joint.sigma == REVOLUTE

    @property
    def prismatic(self) -> bool:
        """Whether the joint slides along its axis z_j."""
        return self.joint.sigma == PRISMATIC

    def path(self) -> Iterator[Frame]:
        """The frame and those that carry it, from here towards the base."""
        frame: Frame | None = self
        while frame is not None:
            yield frame
            frame = frame.parent

    def has_body(self) -> bool:
        """Whether the frame carries a body of its own: all but tool frames do."""
        return not self.joint.tool


@dataclass(frozen=True)
class Chain:
    """The frames of a robot, antecedents first, and the base's pose and gravity.

    ``base_rotation`` and ``base_position`` place frame 0 in the world; ``gravity`` is the free-fall acceleration
    [m/s2] in frame 0. ``values`` maps every symbol of the geometry to its node.
    """

    robot: Robot
    program: Program
    frames: tuple[Frame, ...]
    base_rotation: Array
    base_position: Array
    gravity: Array
    values: Mapping[sympy.Symbol, Node]

    @property
    def dof(self) -> int:
        """Number of moving joints n: the size of q."""
        return len(self.robot.moving)

    @property
    def tool(self) -> Frame:
        """The frame where wrenches act and payloads sit: the file's tool frame, else the last frame."""
        return self.frames[self.robot.tool.number - 1]


def build_chain(robot: Robot, program: Program, values: Mapping[sympy.Symbol, Node]) -> Chain:
    """The chain of ``robot`` with the symbols of its geometry (lengths, joint variables) read from ``values``.

    Named angles that are constants stand in its frames as the numbers they are: quarter turns among them are exact.
    """
    frames: list[Frame] = []
    coordinate = 0
    angles = robot.constant_angles
    for named in robot.joints:
        joint = named.at(angles)
        entry, rotation, position = _transform(joint, program, values)
        parent = frames[joint.antecedent - 1] if joint.antecedent else None
        moving = joint.sigma != FIXED
        frames.append(Frame(joint, entry, rotation, position, coordinate if moving else None, parent))
        coordinate += moving
    base = array(program, [[lower(program, entry, values) for entry in row] for row in robot.base.tolist()])
    world_gravity = array(program, [lower(program, component, values) for component in robot.gravity])
    base_rotation, base_position = base[:3, :3], base[:3, 3]
    gravity = base_rotation.T @ world_gravity
    return Chain(robot, program, tuple(frames), base_rotation, base_position, gravity, values)


def _transform(joint: Joint, program: Program, values: Mapping[sympy.Symbol, Node]) -> tuple[Array, Array, Array]:
    """Entry, rotation and origin of frame j in frame a(j): Rot(z, gamma) Trans(z, b) Rot(x, alpha) Trans(x, d) ..."""
    ct, st = cosine_sine(joint.theta, program, values)
    entry = _entry(joint, program, values)
    d, r, b = (lower(program, length, values) for length in (joint.d, joint.r, joint.b))
    spin = array(program, [[ct, -st, 0], [st, ct, 0], [0, 0, 1]])
    z = array(program, [0, 0, b])
    return entry, entry @ spin, z + d * entry[:, 0] + r * entry[:, 2]


def _entry(joint: Joint, program: Program, values: Mapping[sympy.Symbol, Node]) -> Array:
    """Rot(z, gamma) Rot(x, alpha) (3 x 3)."""
    ca, sa = cosine_sine(joint.alpha, program, values)
    about_x = array(program, [[1, 0, 0], [0, ca, -sa], [0, sa, ca]])
    if joint.gamma == 0:
        return about_x
    cg, sg = cosine_sine(joint.gamma, program, values)
    return array(program, [[cg, -sg, 0], [sg, cg, 0], [0, 0, 1]]) @ about_x


def cosine_sine(angle: sympy.Expr, program: Program, values: Mapping[sympy.Symbol, Node]) -> tuple[Node, Node]:
    """Cosine and sine of an exact angle; quarter turns are taken out exactly, so that no 6e-17 is ever printed."""
    variable, constant = sympy.Integer(0), angle
    if angle.free_symbols:
        constant, variable = angle.as_independent(*angle.free_symbols, as_Add=True)
    quarters = 2 * constant / sympy.pi
    if variable == 0 or not quarters.is_Integer:
        return lower(program, sympy.cos(angle), values), lower(program, sympy.sin(angle), values)
    node = lower(program, variable, values)
    cosine, sine = program.function("cos", node), program.function("sin", node)
    turns = ((cosine, sine), (-sine, cosine), (-cosine, -sine), (sine, -cosine))
    return turns[int(quarters) % 4]


def axis(program: Program) -> Array:
    """The axis z_j of any joint in its frame j."""
    z = zeros(program, 3)
    z[2] = program.one
    return z


def world_transforms(chain: Chain) -> list[tuple[Array, Array]]:
    """Rotation (3 x 3) and origin (3) of every frame in the world frame."""
    placed: list[tuple[Array, Array]] = []
    for frame in chain.frames:
        if frame.parent is None:
            rotation, position = chain.base_rotation, chain.base_position
        else:
            rotation, position = placed[frame.parent.number - 1]
        placed.append((rotation @ frame.rotation, position + rotation @ frame.position))
    return placed


def homogeneous(program: Program, rotation: Array, position: Array) -> Array:
    """The 4 x 4 transformation of a frame."""
    top = np.concatenate([rotation, position.reshape(3, 1)], axis=1)
    return np.concatenate([top, array(program, [[0, 0, 0, 1]])], axis=0)
