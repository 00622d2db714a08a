"""A textbook recursive Newton-Euler in floating point, about the centres of mass: the tests' own second opinion.

Luh, Walker and Paul 1980, with the frames of J. Craig's book (modified Denavit-Hartenberg), branches allowed. It shares
no formula with the generator: bodies are mass, centre and central inertia, and geometry is evaluated with ``math``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import cos, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from generator.robot.description import FIXED, PRISMATIC, REVOLUTE, Joint, Robot

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Body:
    """Mass [kg], centre of mass [m] in the body's frame, inertia tensor [kg m2] about the centre, along its axes."""

    mass: float
    centre: Vector
    inertia: Vector


def body(parameters: Sequence[float]) -> Body:
    """From XX XY XZ YY YZ ZZ MX MY MZ M about the frame's origin; raises ValueError for moments without mass."""
    xx, xy, xz, yy, yz, zz, mx, my, mz, mass = parameters
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    moment = np.array([mx, my, mz])
    if mass == 0.0:
        if moment.any():
            raise ValueError("a body without mass has no first moment")
        return Body(0.0, np.zeros(3), tensor)
    c = moment / mass
    return Body(mass, c, tensor - mass * (c @ c * np.eye(3) - np.outer(c, c)))


class Arm:
    """A robot's bodies and joints as numbers; ``values`` are its standard parameters and its lengths by name."""

    def __init__(self, robot: Robot, values: Mapping[str, float]) -> None:
        self.robot = robot
        lengths = {length.name: float(length.value) for length in robot.lengths} | dict(values)
        self._geometry = {joint.number: _Geometry(joint, lengths) for joint in robot.joints}
        stems = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
        self._bodies = {b.number: body([values.get(f"{s}{b.number}", 0.0) for s in stems]) for b in robot.bodies}
        base = np.array(robot.base.tolist(), dtype=float)
        self._free_fall = base[:3, :3].T @ np.array([float(g) for g in robot.gravity])
        self._coordinate = {joint.number: k for k, joint in enumerate(robot.moving)}

    def torques(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        qdd: ArrayLike,
        *,
        weight: bool = True,
        payload: Sequence[float] | None = None,
        wrench: Sequence[float] | None = None,
    ) -> Vector:
        """Joint torques (n) of the bodies, of a payload in the tool frame and of a wrench of the tool, in its axes."""
        q, qd, qdd = (np.asarray(x, dtype=float) for x in (q, qd, qdd))
        turn: dict[int, Vector] = {}
        shift: dict[int, Vector] = {}
        w, wd, a = {0: np.zeros(3)}, {0: np.zeros(3)}, {0: -self._free_fall if weight else np.zeros(3)}
        for joint in self.robot.joints:
            j, i = joint.number, joint.antecedent
            k = self._coordinate.get(j)
            R, p = turn[j], shift[j] = self._geometry[j].at(0.0 if k is None else q[k])
            carried = a[i] + np.cross(wd[i], p) + np.cross(w[i], np.cross(w[i], p))
            w[j], wd[j], a[j] = R.T @ w[i], R.T @ wd[i], R.T @ carried
            z = np.array([0.0, 0.0, 1.0])
            if joint.sigma == REVOLUTE:
                wd[j] = wd[j] + np.cross(w[j], z * qd[k]) + z * qdd[k]
                w[j] = w[j] + z * qd[k]
            elif joint.sigma == PRISMATIC:
                a[j] = a[j] + 2.0 * np.cross(w[j], z * qd[k]) + z * qdd[k]

        force = {j: np.zeros(3) for j in turn}
        moment = {j: np.zeros(3) for j in turn}
        loads = list(self._bodies.items())
        tool = self.robot.tool.number
        if payload is not None:
            loads.append((tool, body(payload)))
        for j, part in loads:
            at_centre = a[j] + np.cross(wd[j], part.centre) + np.cross(w[j], np.cross(w[j], part.centre))
            F = part.mass * at_centre
            N = part.inertia @ wd[j] + np.cross(w[j], part.inertia @ w[j])
            force[j] += F
            moment[j] += N + np.cross(part.centre, F)
        if wrench is not None:
            force[tool] += wrench[:3]
            moment[tool] += wrench[3:]

        tau = np.zeros(len(self._coordinate))
        for joint in reversed(self.robot.joints):
            j, i = joint.number, joint.antecedent
            if joint.sigma != FIXED:
                tau[self._coordinate[j]] = moment[j][2] if joint.sigma == REVOLUTE else force[j][2]
            if i:
                f = turn[j] @ force[j]
                force[i] += f
                moment[i] += turn[j] @ moment[j] + np.cross(shift[j], f)
        return tau

    def inertia_matrix(self, q: ArrayLike) -> Vector:
        """M(q) (n x n) of the bodies, column by column from unit accelerations (Walker and Orin 1982, method 1)."""
        n = len(self._coordinate)
        rest = np.zeros(n)
        return np.stack([self.torques(q, rest, unit, weight=False) for unit in np.eye(n)], axis=1)

    def gravity(self, q: ArrayLike) -> Vector:
        """Torques (n) that hold the weight."""
        rest = np.zeros(len(self._coordinate))
        return self.torques(q, rest, rest)


class _Geometry:
    """One joint's transformation from its antecedent, the angles and lengths as floats."""

    def __init__(self, joint: Joint, lengths: Mapping[str, float]) -> None:
        def number(expression: object) -> float:
            return float(expression.subs({**lengths_by_symbol, joint.variable: 0}))  # type: ignore[attr-defined]

        lengths_by_symbol = {s: lengths[s.name] for s in _symbols(joint) if s != joint.variable}
        self.sigma = joint.sigma
        self.gamma, self.b, self.alpha, self.d = (number(x) for x in (joint.gamma, joint.b, joint.alpha, joint.d))
        self.theta, self.r = number(joint.theta), number(joint.r)

    def at(self, q: float) -> tuple[Vector, Vector]:
        """Axes and origin of the frame in its antecedent (Khalil and Kleinfinger 1986, written out)."""
        theta = self.theta + q if self.sigma == REVOLUTE else self.theta
        r = self.r + q if self.sigma == PRISMATIC else self.r
        cg, sg, ca, sa, ct, st = (f(x) for x in (self.gamma, self.alpha, theta) for f in (cos, sin))
        rotation = np.array(
            [
                [cg * ct - sg * ca * st, -cg * st - sg * ca * ct, sg * sa],
                [sg * ct + cg * ca * st, -sg * st + cg * ca * ct, -cg * sa],
                [sa * st, sa * ct, ca],
            ]
        )
        return rotation, np.array([self.d * cg + r * sg * sa, self.d * sg - r * cg * sa, r * ca + self.b])


def _symbols(joint: Joint) -> set[object]:
    expressions = (joint.gamma, joint.b, joint.alpha, joint.d, joint.theta, joint.r)
    return set().union(*(expression.free_symbols for expression in expressions))
