"""Lagrange's equations of the bodies alone, in homogeneous coordinates.

With the pseudo-inertia Sigma_j of body j and its pose T_j: kinetic energy 1/2 sum tr(T_j' Sigma_j T_j'^T), potential
energy -sum g^T T_j Sigma_j e4, and therefore tau_i = sum tr(dT_j/dq_i Sigma_j (T_j'' - g e4^T)^T) over the bodies that
joint i carries. Source: J. J. Uicker, On the Dynamic Analysis of Spatial Linkages Using 4 x 4 Matrices, 1965;
R. P. Paul, Robot Manipulators, 1981, ch. 6. ``matter`` maps frame numbers to pseudo-inertias.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from decimal import Decimal

import numpy as np

from generator.reference.arithmetic import Array, zeros
from generator.reference.chain import Chain
from generator.reference.matter import units
from generator.reference.motion import generators, motion, poses

Matter = Mapping[int, Array]


def torque(chain: Chain, matter: Matter, q: Array, qd: Array, qdd: Array) -> Array:
    """Joint torques [N m], forces [N] (n) that move the bodies and hold them against gravity."""
    moved = motion(chain, q, qd, qdd)
    D, tau = generators(chain, moved.pose), zeros(chain.dof)
    for j, sigma in matter.items():
        flow = moved.pose[j] @ sigma @ (moved.acceleration[j] - _free_fall(chain)).T
        for i in chain.links[j - 1].carriers:
            tau[i] += np.sum(D[i] * flow.T)
    return tau


def columns(chain: Chain, numbers: Iterable[int], q: Array, qd: Array, qdd: Array) -> dict[int, dict[str, Array]]:
    """By the number of a frame, torques (n) per unit of each inertial parameter of a body there."""
    moved = motion(chain, q, qd, qdd)
    D, unit = generators(chain, moved.pose), units()
    result = {number: {name: zeros(chain.dof) for name in unit} for number in numbers}
    for number, torques in result.items():
        T, B = moved.pose[number], moved.acceleration[number] - _free_fall(chain)
        for i in chain.links[number - 1].carriers:
            weight = (D[i] @ T).T @ B
            for name, sigma in unit.items():
                torques[name][i] = np.sum(weight * sigma)
    return result


def inertia_matrix(chain: Chain, matter: Matter, q: Array) -> Array:
    """M(q) (n x n): the coefficients of 1/2 q'_i q'_k in the kinetic energy."""
    pose = poses(chain, q)
    D, M = generators(chain, pose), zeros(chain.dof, chain.dof)
    for j, sigma in matter.items():
        spread = pose[j] @ sigma @ pose[j].T
        for i in chain.links[j - 1].carriers:
            swept = D[i] @ spread
            for k in chain.links[j - 1].carriers:
                M[i, k] += np.sum(swept * D[k])
    return M


def gravity(chain: Chain, matter: Matter, q: Array) -> Array:
    """Torques (n) that hold the bodies against gravity: the gradient of the potential energy."""
    pose = poses(chain, q)
    D, tau = generators(chain, pose), zeros(chain.dof)
    for j, sigma in matter.items():
        moment = pose[j] @ sigma[:, 3]
        for i in chain.links[j - 1].carriers:
            tau[i] -= chain.gravity @ (D[i] @ moment)[:3]
    return tau


def kinetic_energy(chain: Chain, matter: Matter, q: Array, qd: Array) -> Decimal:
    """1/2 sum tr(T' Sigma T'^T) [J]."""
    velocity = motion(chain, q, qd, zeros(chain.dof)).velocity
    return sum((np.sum((velocity[j] @ sigma) * velocity[j]) for j, sigma in matter.items()), Decimal(0)) / 2


def potential_energy(chain: Chain, matter: Matter, q: Array) -> Decimal:
    """-sum g^T T Sigma e4 [J], measured from the origin of the world."""
    pose = poses(chain, q)
    return -sum((chain.gravity @ (pose[j] @ sigma[:, 3])[:3] for j, sigma in matter.items()), Decimal(0))


def _free_fall(chain: Chain) -> Array:
    """G e4^T (4 x 4): the second derivative of the pose of a frame that falls freely without turning."""
    result = zeros(4, 4)
    result[:3, 3] = chain.gravity
    return result
