"""Poses of all frames and their exact first and second time derivatives, as 4 x 4 matrices."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from generator.reference.arithmetic import Array, zeros
from generator.reference.chain import Chain, inverse


@dataclass(frozen=True)
class Motion:
    """By frame number, in the world frame: the pose T, dT/dt and d2T/dt2 (4 x 4)."""

    pose: Mapping[int, Array]
    velocity: Mapping[int, Array]
    acceleration: Mapping[int, Array]


def poses(chain: Chain, q: Array) -> dict[int, Array]:
    """Pose of every frame in the world frame (4 x 4), by number; 0 is the base."""
    placed = {0: chain.base}
    for link in chain.links:
        placed[link.number] = placed[link.antecedent] @ link.pose(q)
    return placed


def motion(chain: Chain, q: Array, qd: Array, qdd: Array) -> Motion:
    """Product rule along the chain: T_j = T_a A with dA/dq = A rate, d2A/dq2 = A rate^2."""
    T, V, B = {0: chain.base}, {0: zeros(4, 4)}, {0: zeros(4, 4)}
    for link in chain.links:
        j, a, A = link.number, link.antecedent, link.pose(q)
        T[j], V[j], B[j] = T[a] @ A, V[a] @ A, B[a] @ A
        if link.coordinate is not None and link.rate is not None:
            speed, acceleration = qd[link.coordinate], qdd[link.coordinate]
            A1 = A @ link.rate
            A2 = A1 @ link.rate
            B[j] = B[j] + 2 * speed * (V[a] @ A1) + T[a] @ (speed * speed * A2 + acceleration * A1)
            V[j] = V[j] + speed * (T[a] @ A1)
    return Motion(T, V, B)


def generators(chain: Chain, pose: Mapping[int, Array]) -> list[Array]:
    """By coordinate i, the matrix D_i (4 x 4) with dT_j/dq_i = D_i T_j for every frame j that the joint carries."""
    return [pose[link.number] @ link.rate @ inverse(pose[link.number]) for link in chain.links if link.rate is not None]


def jacobian(chain: Chain, pose: Mapping[int, Array], number: int) -> Array:
    """Jacobian (6 x n) of frame ``number``: velocity of its origin, then angular velocity, in world axes."""
    D, result = generators(chain, pose), zeros(6, chain.dof)
    for i in chain.links[number - 1].carriers:
        result[:3, i] = (D[i] @ pose[number])[:3, 3]
        result[3:, i] = D[i][2, 1], D[i][0, 2], D[i][1, 0]
    return result


def stacked(chain: Chain, matrices: Mapping[int, Array]) -> Array:
    """The matrices of all frames, in order, the base left out."""
    return np.stack([matrices[link.number] for link in chain.links])
