"""Newton-Euler by hand in CasADi: what a practitioner would write who knows the robot's base parameters.

Geometry is numbers with exact zeros, parameters are symbols, and those that were grouped away are exact zeros too, so
that CasADi's SX leaves out every product with them. Frames are those of modified Denavit-Hartenberg notation.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import casadi as ca
import numpy as np

from benchmarks.peers.subject import Chain
from tests.bodies import PINOCCHIO


@dataclass(frozen=True)
class Body:
    """Mass, first moments (3) and inertia tensor about the frame's origin (3 x 3), in the link's frame."""

    mass: ca.SX
    first: ca.SX
    tensor: ca.SX


@dataclass(frozen=True)
class Motion:
    """A frame's angular velocity, angular acceleration and its origin's acceleration less gravity, in its own axes."""

    w: ca.SX
    wd: ca.SX
    a: ca.SX


class Recursion:
    """Expressions of a robot's dynamics in ``q``, ``qd``, ``qdd`` (or ``tau``) and ``parameters``, the base ones."""

    def __init__(self, subject: Chain) -> None:
        self._subject = subject
        self.q, self.qd, self.qdd, self.tau = (ca.SX.sym(name, subject.dof) for name in ("q", "qd", "qdd", "tau"))
        self.parameters = ca.SX.sym("parameters", len(subject.base))
        heads = {base.head: self.parameters[k] for k, base in enumerate(subject.model.grouping.base)}
        self._given = heads

    @property
    def inverse_dynamics(self) -> ca.SX:
        """Torques (n) with the rotors' part."""
        return self._torques(list(self._motions(self.qd, self.qdd))) + self._rotors * self.qdd

    @property
    def gravity(self) -> ca.SX:
        """Torques (n) that hold the weight."""
        zero = ca.SX(self._subject.dof, 1)
        return self._torques(list(self._motions(zero, zero)))

    @property
    def regressor(self) -> ca.SX:
        """The torques' derivatives by the parameters (n x columns), which the torques are linear in."""
        return ca.densify(ca.jacobian(self.inverse_dynamics, self.parameters))

    @property
    def inertia_matrix(self) -> ca.SX:
        """M (n x n) by composite bodies."""
        n, links = self._subject.dof, self._subject.links
        M = ca.SX(n, n)
        composite = [self._body(link.number) for link in links]
        for j in reversed(range(n)):
            body = composite[j]
            if links[j].prismatic:
                force, moment = body.mass * _Z, ca.cross(body.first, _Z)
            else:
                force, moment = ca.cross(_Z, body.first), body.tensor @ _Z
            M[j, j] = (force if links[j].prismatic else moment)[2]
            for i in reversed(range(j)):
                rotation, position = self._place[i + 1]
                force = rotation @ force
                moment = rotation @ moment + ca.cross(position, force)
                M[i, j] = M[j, i] = (force if links[i].prismatic else moment)[2]
            if j:
                rotation, position = self._place[j]
                composite[j - 1] = _joined(composite[j - 1], _carried(body, rotation, position))
        return M + ca.diag(self._rotors)

    @property
    def direct_dynamics(self) -> ca.SX:
        """Accelerations (n): M qdd = tau - H by L^T D L, from the last joint to the first."""
        zero = ca.SX(self._subject.dof, 1)
        rest = self.tau - self._torques(list(self._motions(self.qd, zero)))
        n, M = self._subject.dof, ca.SX(self.inertia_matrix)
        pivots: list[ca.SX] = [ca.SX(0)] * n
        for k in reversed(range(n)):
            pivots[k] = 1 / M[k, k]
            for i in reversed(range(k)):
                factor = M[k, i] * pivots[k]
                for j in reversed(range(i + 1)):
                    M[i, j] -= factor * M[k, j]
                M[k, i] = factor
        for k in reversed(range(n)):
            for i in range(k):
                rest[i] -= M[k, i] * rest[k]
        for k in range(n):
            rest[k] = rest[k] * pivots[k] - sum((M[k, i] * rest[i] for i in range(k)), ca.SX(0))
        return rest

    def expressions(self) -> Iterator[tuple[str, dict[str, ca.SX], ca.SX]]:
        """Each function's name, its inputs by the names of the common signature, and its output, dense."""
        moved, motion = {"parameters": self.parameters, "q": self.q}, {"q": self.q, "qd": self.qd, "third": self.qdd}
        for name, inputs in (
            ("inverse_dynamics", {**moved, **motion}),
            ("inertia_matrix", moved),
            ("direct_dynamics", {**moved, **motion, "third": self.tau}),
            ("regressor", motion),
            ("gravity", moved),
        ):
            yield name, inputs, ca.cse(ca.densify(getattr(self, name)))

    @cached_property
    def _place(self) -> list[tuple[ca.SX, ca.SX]]:
        """Each link's rotation and position in its antecedent."""
        result = []
        for k, link in enumerate(self._subject.links):
            rotation, position = ca.sparsify(ca.SX(link.rotation)), ca.sparsify(ca.SX(link.position))
            if link.prismatic:
                position = position + rotation @ (self.q[k] * _Z)
            else:
                c, s = ca.cos(self.q[k]), ca.sin(self.q[k])
                rotation = rotation @ ca.sparsify(ca.blockcat([[c, -s, 0], [s, c, 0], [0, 0, 1]]))
            result.append((rotation, position))
        return result

    @property
    def _rotors(self) -> ca.SX:
        return ca.vertcat(*(self._given.get(f"Ia{link.number}", ca.SX(0)) for link in self._subject.links))

    def _body(self, number: int) -> Body:
        mass, mx, my, mz, xx, xy, yy, xz, yz, zz = (self._given.get(f"{stem}{number}", ca.SX(0)) for stem in PINOCCHIO)
        tensor = ca.sparsify(ca.blockcat([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
        return Body(mass, ca.sparsify(ca.vertcat(mx, my, mz)), tensor)

    def _motions(self, qd: ca.SX, qdd: ca.SX) -> Iterator[Motion]:
        """From the base, which gravity accelerates upward, to the last link."""
        gravity = np.array([float(g) for g in self._subject.robot.gravity])
        last = Motion(ca.SX(3, 1), ca.SX(3, 1), ca.sparsify(ca.SX(-gravity)))
        for k, (link, (rotation, position)) in enumerate(zip(self._subject.links, self._place, strict=True)):
            carried = rotation.T @ (last.a + _turning(last) @ position)
            w, wd = rotation.T @ last.w, rotation.T @ last.wd
            if link.prismatic:
                last = Motion(w, wd, carried + qdd[k] * _Z + 2 * qd[k] * ca.cross(w, _Z))
            else:
                last = Motion(w + qd[k] * _Z, wd + qdd[k] * _Z + ca.cross(w, qd[k] * _Z), carried)
            yield last

    def _torques(self, motions: list[Motion]) -> ca.SX:
        """From the last link to the base: what each joint supplies."""
        n, links = self._subject.dof, self._subject.links
        force, moment = ca.SX(3, 1), ca.SX(3, 1)
        torques: list[ca.SX] = [ca.SX(0)] * n
        for k in reversed(range(n)):
            if k + 1 < n:
                rotation, position = self._place[k + 1]
                force = rotation @ force
                moment = rotation @ moment + ca.cross(position, force)
            own_force, own_moment = _needed(self._body(links[k].number), motions[k])
            force, moment = force + own_force, moment + own_moment
            torques[k] = (force if links[k].prismatic else moment)[2]
        return ca.vertcat(*torques)


_Z = ca.sparsify(ca.SX([0, 0, 1]))


def _turning(motion: Motion) -> ca.SX:
    """U with U r the acceleration of a point r of the frame against its origin."""
    return ca.skew(motion.wd) + ca.skew(motion.w) @ ca.skew(motion.w)


def _needed(body: Body, motion: Motion) -> tuple[ca.SX, ca.SX]:
    """Force and moment about the origin that move a body so."""
    force = body.mass * motion.a + _turning(motion) @ body.first
    moment = body.tensor @ motion.wd + ca.cross(motion.w, body.tensor @ motion.w) + ca.cross(body.first, motion.a)
    return force, moment


def _carried(body: Body, rotation: ca.SX, position: ca.SX) -> Body:
    """A body's parameters in the antecedent's frame."""
    first = rotation @ body.first
    tensor = rotation @ body.tensor @ rotation.T
    shift, twice = ca.skew(position), ca.skew(first)
    tensor = tensor - shift @ twice - twice @ shift - body.mass * (shift @ shift)
    return Body(body.mass, first + body.mass * position, tensor)


def _joined(a: Body, b: Body) -> Body:
    return Body(a.mass + b.mass, a.first + b.first, a.tensor + b.tensor)
