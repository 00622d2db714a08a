"""Velocities and Jacobians of the frames."""

from __future__ import annotations

from dataclasses import dataclass

from generator.symbolic.frames import Chain, Frame, axis, world_transforms
from generator.symbolic.vectors import Array, Nodes, cross, zeros


@dataclass(frozen=True)
class Velocity:
    """Angular velocity ``w`` [rad/s] and velocity ``v`` of the origin [m/s] of frame j, in frame j."""

    w: Array
    v: Array


def velocities(chain: Chain, qd: Nodes) -> dict[int, Velocity]:
    """Velocities of all frames relative to frame 0, by frame number, at the joint speeds ``qd`` (n) [rad/s, m/s]."""
    program = chain.program
    result: dict[int, Velocity] = {}
    for frame in chain.frames:
        z = axis(program)
        before = result[frame.parent.number] if frame.parent else Velocity(zeros(program, 3), zeros(program, 3))
        w = frame.rotation.T @ before.w
        v = frame.rotation.T @ (before.v + cross(before.w, frame.position))
        if frame.coordinate is not None:
            if frame.revolute:
                w = w + qd[frame.coordinate] * z
            else:
                v = v + qd[frame.coordinate] * z
        result[frame.number] = Velocity(w, v)
    return result


def jacobian(chain: Chain, frame: Frame) -> Array:
    """Jacobian (6 x n) of a frame: rows 1-3 the velocity of its origin, 4-6 the angular velocity, in world axes."""
    placed = world_transforms(chain)
    origin = placed[frame.number - 1][1]
    result = zeros(chain.program, 6, chain.dof)
    for carrier in frame.path():
        if carrier.coordinate is None:
            continue
        rotation, position = placed[carrier.number - 1]
        z = rotation[:, 2]
        if carrier.revolute:
            result[:3, carrier.coordinate] = cross(z, origin - position)
            result[3:, carrier.coordinate] = z
        else:
            result[:3, carrier.coordinate] = z
    return result


@dataclass(frozen=True)
class Screw:
    """Motion of frame j per unit speed of one joint that carries it: ``w`` and ``v`` of O_j, in frame j."""

    w: Array
    v: Array
