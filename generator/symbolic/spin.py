"""Rotation of the bodies with few operations: angular velocity, its products, and U = skew(wd) + skew(w)^2.

U of a body, written in its own or in its unspun axes, has as third column U z, and that column is the antecedent's:
the axis z_j is fixed in the antecedent, so U_j z_j = U_a(j) z_j. It gives the angular acceleration across z without
turning one, and its last entry gives the sum of two squares.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from generator.symbolic.segments import Spun
from generator.symbolic.statements import Node, Program
from generator.symbolic.vectors import Array, skew, zeros


@dataclass(frozen=True)
class Spin:
    """Rotation of a body in some axes: ``w`` (3), products ``ww`` = w w^T (3 x 3), ``wd`` (3), ``u`` (3 x 3).

    ``differences`` are w3 w3 - w2 w2, w1 w1 - w3 w3, w2 w2 - w1 w1.
    """

    w: Array
    ww: Array
    wd: Array
    u: Array
    differences: Array

    def turned(self, entry: Array) -> Spin:
        """The same rotation in the axes that are the columns of ``entry``, a matrix of zeros and signs."""
        back = entry.T
        ww = back @ self.ww @ entry
        return Spin(back @ self.w, ww, back @ self.wd, back @ self.u @ entry, _differences(ww))


@dataclass(frozen=True)
class Turning:
    """What the moment of a body needs of its rotation: ``u`` (3 x 3) and ``differences`` of products of w (3).

    ``about_z`` is wd3 where w1 w2 is zero, so that U12 and U21 are wd3 but for the sign, else None.
    """

    u: Array
    differences: Array
    about_z: Node | None


def turning(spin: Spin) -> Turning:
    """A rotation as the moments need it."""
    alone = spin.ww[0, 1] is spin.ww[0, 1].program.zero
    return Turning(spin.u, spin.differences, spin.wd[2] if alone else None)


def turning_tip(carried: Spin, rate: Node, acceleration: Node) -> Turning:
    """As ``with_rate``, where nothing is carried: fewer operations, without angular acceleration and products."""
    u = carried.u + added_u(carried, rate, acceleration)
    fast = (carried.w[2] + rate) * (carried.w[2] + rate)
    u[0, 0], u[1, 1] = -(carried.ww[1, 1] + fast), -(carried.ww[0, 0] + fast)
    differences = [fast - carried.ww[1, 1], carried.ww[0, 0] - fast, carried.differences[2]]
    return Turning(u, np.array(differences, dtype=object), None)


def _differences(ww: Array) -> Array:
    return np.array([ww[2, 2] - ww[1, 1], ww[0, 0] - ww[2, 2], ww[1, 1] - ww[0, 0]], dtype=object)


def standing(program: Program) -> Spin:
    """The base."""
    nothing, none = zeros(program, 3), zeros(program, 3, 3)
    return Spin(nothing, none, nothing, none, nothing)


def spin_from_rates(w: Array, wd: Array) -> Spin:
    """The rotation with everything computed from w and wd: where no product is known."""
    ww = np.empty((3, 3), dtype=object)
    for i in range(3):
        for k in range(i, 3):
            ww[i, k] = ww[k, i] = w[i] * w[k]
    u = skew(wd) + ww
    for i in range(3):
        u[i, i] = -(ww[(i + 1) % 3, (i + 1) % 3] + ww[(i + 2) % 3, (i + 2) % 3])
    return Spin(w, ww, wd, u, _differences(ww))


def entered(spun: Spun, before: Spin) -> Spin:
    """The antecedent's rotation in the unspun axes of a frame."""
    if spun.continues:
        return before
    if spun.quarter:
        return before.turned(spun.entry)
    back = spun.entry.T
    return spin_from_rates(back @ before.w, back @ before.wd)


def with_rate(carried: Spin, rate: Node, acceleration: Node) -> Spin:
    """The rotation of a body that turns about z at ``rate`` on what carries it, in unspun axes."""
    w = np.array([carried.w[0], carried.w[1], carried.w[2] + rate], dtype=object)
    return _completed(w, carried.ww[:2, :2], carried.u[:, 2], carried.wd[2] + acceleration)


def added_u(carried: Spin, rate: Node, acceleration: Node) -> Array:
    """U of a body in unspun axes without that of what carries it: what its ``rate`` about z adds (3 x 3).

    skew(z) acceleration + skew(z)^2 rate^2 + 2 skew(w) skew(z) rate; nothing moves along z itself, so that the third
    column is zero.
    """
    zero = rate.program.zero
    x, y, z = carried.w
    inward = -(rate * (z + (z + rate)))
    # With z = 0 the products are those of w itself, which is used elsewhere.
    last = [2 * (rate * x), 2 * (rate * y)] if z is zero else [(2 * rate) * x, (2 * rate) * y]
    rows = [[inward, -acceleration, zero], [acceleration, inward, zero], [*last, zero]]
    return np.array(rows, dtype=object)


def in_own_axes(unspun: Spin, spun: Spun, asked: Collection[int] = (0, 1)) -> Spin:
    """The same rotation in the frame's own axes.

    The last row of U follows from its last column without the components 0 and 1 of the angular acceleration that no
    frame has ``asked`` for; what that takes is shared by both entries, and with the torque of an unspun body.
    """
    w, column = spun.to_own(unspun.w), spun.to_own(unspun.u[:, 2])
    first = w[0] * w[0]
    mixed = w[0] * w[1]
    across = np.array([[first, mixed], [mixed, -(column[2] + first)]], dtype=object)
    own = _completed(w, across, column, unspun.wd[2])
    # With U33 known, two sums of squares give the whole diagonal and the differences.
    p33 = w[2] * w[2]
    difference = first - p33
    own.u[0, 0], own.u[1, 1] = column[2] + difference, -(first + p33)
    other = column[2] - own.u[1, 1]
    own.differences[:] = [other, difference, -(other + difference)]
    for k in {0, 1}.difference(asked):
        own.u[2, 1 - k] = (2 * w[2]) * w[1 - k] - column[1 - k]
    return own


def _completed(w: Array, across: Array, column: Array, spin_up: Node) -> Spin:
    """U and the products from w, the products of w1 and w2, the third column of U and wd3."""
    p13, p23, p33 = w[0] * w[2], w[1] * w[2], w[2] * w[2]
    (p11, p12), (_, p22) = across
    ww = np.array([[p11, p12, p13], [p12, p22, p23], [p13, p23, p33]], dtype=object)
    wd = np.array([p23 - column[1], column[0] - p13, spin_up], dtype=object)
    u = np.array(
        [
            [-(p22 + p33), p12 - spin_up, column[0]],
            [p12 + spin_up, -(p11 + p33), column[1]],
            [p13 - wd[1], p23 + wd[0], column[2]],
        ],
        dtype=object,
    )
    return Spin(w, ww, wd, u, _differences(ww))


def moment(turning: Turning, sigma: Array, about_z: Node) -> Array:
    """The moment that turns a body about its origin: vee(U S - (U S)^T) with S = (tr J / 2) I - J its pseudo-inertia.

    Equal to J wd + w x J w; written by differences of products of w, which are shared over the body's six terms.
    ``about_z`` is S11 + S22, which may be known where S11 and S22 change.
    """
    u, d, s = turning.u, turning.differences, sigma
    x = u[2, 1] * s[1, 1] - u[1, 2] * s[2, 2] + d[0] * s[1, 2]
    y = u[0, 2] * s[2, 2] - u[2, 0] * s[0, 0] + d[1] * s[0, 2]
    z = u[1, 0] * s[0, 0] - u[0, 1] * s[1, 1] if turning.about_z is None else turning.about_z * about_z
    return np.array(
        [
            x + u[2, 0] * s[0, 1] - u[1, 0] * s[0, 2],
            y + u[0, 1] * s[1, 2] - u[2, 1] * s[0, 1],
            z + d[2] * s[0, 1] + u[1, 2] * s[0, 2] - u[0, 2] * s[1, 2],
        ],
        dtype=object,
    )


def moment_of(u: Array, t: Array) -> Array:
    """vee(U T - (U T)^T) for any matrix T of second moments (3 x 3), symmetric or not."""
    n = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        mixed = (u[k, k] - u[j, j]) * t[k, j] if t[k, j] is t[j, k] else u[k, k] * t[k, j] - u[j, j] * t[j, k]
        n.append(u[k, j] * t[j, j] - u[j, k] * t[k, k] + mixed + (u[k, i] * t[i, j] - u[j, i] * t[i, k]))
    return np.array(n, dtype=object)
