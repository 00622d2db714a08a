"""The arm in numbers: where the frames are, and the corners of the links between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import sympy
from numpy.typing import ArrayLike, NDArray

from generator.robot.description import PRISMATIC, REVOLUTE, Joint, Robot

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Link:
    """Numbers of one joint's row of the Denavit-Hartenberg table [rad, m]; theta and r are for q = 0."""

    joint: Joint
    coordinate: int | None
    gamma: float
    b: float
    alpha: float
    d: float
    theta: float
    r: float


@dataclass(frozen=True)
class Skeleton:
    """A robot's numeric geometry: its links, the pose of frame 0 and the upward direction in the world frame."""

    robot: Robot
    links: tuple[Link, ...]
    base: Array
    up: Array

    @property
    def size(self) -> float:
        """Mean length of the links that have any [m]."""
        shifts = [abs(s) for link in self.links for s in (link.b, link.d, link.r) if s]
        return sum(shifts) / len(shifts) if shifts else 1.0

    @property
    def longest(self) -> float:
        """Length of the longest link [m]."""
        return max([abs(s) for link in self.links for s in (link.b, link.d, link.r)] or [0.0]) or 1.0


@dataclass(frozen=True)
class Placement:
    """Frames and corners in the world frame, leading axes being configurations.

    ``frames`` (..., 1 + joints, 4, 4) from frame 0 on; ``corners`` (..., joints, 4, 3): for each joint its antecedent's
    origin, then the points after b, after d and after r, which is the joint's own origin.
    """

    frames: Array
    corners: Array


def skeleton(robot: Robot) -> Skeleton:
    """The numeric geometry of a robot at the nominal values of its lengths."""
    values = robot.geometry

    def number(expression: sympy.Expr, joint: Joint) -> float:
        return float(expression.xreplace({**values, joint.variable: sympy.Integer(0)}))

    coordinates = {joint.number: index for index, joint in enumerate(robot.moving)}
    links = tuple(
        Link(
            joint,
            coordinates.get(joint.number),
            *(number(e, joint) for e in (joint.gamma, joint.b, joint.alpha, joint.d, joint.theta, joint.r)),
        )
        for joint in robot.joints
    )
    base = np.array(robot.base.tolist(), dtype=float)
    gravity = np.array([float(component) for component in robot.gravity])
    strength = float(np.linalg.norm(gravity))
    return Skeleton(robot, links, base, -gravity / strength if strength else base[:3, 2])


def place(arm: Skeleton, q: ArrayLike) -> Placement:
    """Frames and corners at the joint positions ``q`` (..., n) [rad, m]."""
    positions = np.asarray(q, dtype=float)
    shape = positions.shape[:-1]
    frames = [np.broadcast_to(arm.base, (*shape, 4, 4))]
    corners = []
    for link in arm.links:
        moved = np.zeros(shape) if link.coordinate is None else positions[..., link.coordinate]
        theta = link.theta + (moved if link.joint.sigma == REVOLUTE else 0.0) + np.zeros(shape)
        r = link.r + (moved if link.joint.sigma == PRISMATIC else 0.0) + np.zeros(shape)
        start = frames[link.joint.antecedent]
        after_b = start @ _screw(2, link.gamma, link.b)
        after_d = after_b @ _screw(0, link.alpha, link.d)
        end = after_d @ _screws_z(theta, r)
        frames.append(end)
        corners.append(np.stack([frame[..., :3, 3] for frame in (start, after_b, after_d, end)], axis=-2))
    return Placement(np.stack(frames, axis=-3), np.stack(corners, axis=-3))


def _screw(axis: int, angle: float, shift: float) -> Array:
    """Rotation about and translation along axis 0 (x) or 2 (z)."""
    matrix = np.eye(4)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix[i, i] = matrix[j, j] = np.cos(angle)
    matrix[i, j], matrix[j, i] = -np.sin(angle), np.sin(angle)
    matrix[axis, 3] = shift
    return matrix


def _screws_z(angle: Array, shift: Array) -> Array:
    matrix = np.zeros((*angle.shape, 4, 4))
    matrix[..., 0, 0] = matrix[..., 1, 1] = np.cos(angle)
    matrix[..., 1, 0] = np.sin(angle)
    matrix[..., 0, 1] = -matrix[..., 1, 0]
    matrix[..., 2, 2] = matrix[..., 3, 3] = 1.0
    matrix[..., 2, 3] = shift
    return matrix
