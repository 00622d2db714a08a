"""Bodies by their pseudo-inertia S = (tr J / 2) I - J, the integral of r r^T dm: it turns and shifts like one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from generator.symbolic.bodies import Body
from generator.symbolic.segments import Spun
from generator.symbolic.statements import Node, Program
from generator.symbolic.vectors import Array, zeros


@dataclass(frozen=True)
class Matter:
    """A body in some axes about some origin: pseudo-inertia ``sigma`` (3 x 3), first ``moment`` (3), ``mass``."""

    sigma: Array
    moment: Array
    mass: Node

    def __add__(self, other: Matter) -> Matter:
        return Matter(self.sigma + other.sigma, self.moment + other.moment, self.mass + other.mass)


def matter(body: Body) -> Matter:
    """The pseudo-inertia of a body given by its inertia tensor."""
    j = body.inertia
    half = (j[0, 0] + j[1, 1] + j[2, 2]) / 2
    sigma = -j
    for i in range(3):
        sigma[i, i] = half - j[i, i]
    return Matter(sigma, body.moment, body.mass)


def about_z(part: Matter) -> Node:
    """Moment of inertia about z: S11 + S22, the same in own and in unspun axes."""
    total: Node = part.sigma[0, 0] + part.sigma[1, 1]
    return total


def inertia(part: Matter) -> Array:
    """The inertia tensor J = tr(S) I - S."""
    s = part.sigma
    tensor = -s
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        tensor[i, i] = s[a, a] + s[b, b]
    return tensor


def moved(part: Matter, entry: Array, position: Array) -> Matter:
    """The same matter in the antecedent: ``entry`` holds its axes there, ``position`` its origin."""
    moment = entry @ part.moment
    arm = moment + part.mass * position
    sigma = entry @ part.sigma @ entry.T
    shifted = sigma.copy()
    for i in range(3):
        for k in range(i, 3):
            shifted[i, k] = shifted[k, i] = sigma[i, k] + position[i] * moment[k] + arm[i] * position[k]
    return Matter(shifted, arm, part.mass)


def unspun(part: Matter, spun: Spun) -> Matter:
    """A body of own axes in the unspun ones."""
    return _turned(part, spun.cosine, spun.sine)


def spun_again(part: Matter, spun: Spun) -> Matter:
    """A body of unspun axes in the own ones."""
    return _turned(part, spun.cosine, -spun.sine)


def _turned(part: Matter, c: Node, s: Node) -> Matter:
    """A body turned about z by the angle of cosine c and sine s.

    With u = s (S11 - S22) + 2 c S12 the turned tensor is S11 - s u, S22 + s u, c u - S12: fewer operations than by
    the double angle, and none of its own trigonometry.
    """
    (a, b, x), (_, d, y), (_, _, z) = part.sigma
    u = s * (a - d) + c * (2 * b)
    across, shift = c * u - b, s * u
    xz, yz = c * x - s * y, s * x + c * y
    sigma = np.array([[a - shift, across, xz], [across, d + shift, yz], [xz, yz, z]], dtype=object)
    mx, my, mz = part.moment
    return Matter(sigma, np.array([c * mx - s * my, s * mx + c * my, mz], dtype=object), part.mass)


def nothing(program: Program) -> Matter:
    """No matter."""
    return Matter(zeros(program, 3, 3), zeros(program, 3), program.zero)
