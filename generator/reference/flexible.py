"""Elastic drive trains (report section 2.2, eq. 7-13): q = [q_m; q_e], q_e for the elastic joints only.

The link side is the rigid robot at q_a = q_m + q_e; an elastic joint's motor has Iam, Fvm, Fcm, Offm and a spring k.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal

import numpy as np

from generator.reference.arithmetic import Array, exact, sign, solve, zeros
from generator.reference.rigid import Rigid
from generator.robot.description import Robot

#: Parameters of a motor and its spring, in the order of report eq. 12.
MOTOR_SIDE = ("Iam", "Fvm", "Fcm", "Offm", "k")


@dataclass(frozen=True)
class Flexible:
    """``link`` is the robot behind the springs; ``elastic`` maps each elastic joint's coordinate to its number.

    ``gaps`` are the backlashes by joint number, where there are any. ``direction`` stands for the signs of the motors'
    speeds, where it is given.
    """

    link: Rigid
    elastic: dict[int, int]
    gaps: Mapping[int, Decimal]
    direction: Array | None = None

    @property
    def dof(self) -> int:
        """Number of moving joints n: the size of q_m."""
        return self.link.chain.dof

    def sliding(self, direction: Array) -> Flexible:
        """The same robot with ``direction`` for the signs of the speeds of the motors, then of the elastic links."""
        of_links = direction[: self.dof].copy()
        of_links[list(self.elastic)] = direction[self.dof :]
        return replace(self, link=self.link.sliding(of_links), direction=direction)

    def surface_speeds(self, qd: Array) -> Array:
        """Speeds of the motors, then of the links of the elastic joints."""
        return np.concatenate([qd[: self.dof], self.at_links(qd)[list(self.elastic)]])

    def at_links(self, stacked: Array) -> Array:
        """q_a (n) of [q_m; q_e], and likewise for speeds and accelerations."""
        result = stacked[: self.dof].copy()
        result[list(self.elastic)] += stacked[self.dof :]
        return result

    def inverse_dynamics(self, q: Array, qd: Array, qdd: Array) -> tuple[Array, Array]:
        """tau_mdi (n) and tau_e = M(q_a) qdd_a + H(q_a, qd_a) on the elastic joints (eq. 8, 10)."""
        of_links = self.link.inverse_dynamics(self.at_links(q), self.at_links(qd), self.at_links(qdd))
        tau = of_links.copy()
        for e, (i, number) in enumerate(self.elastic.items()):
            columns = self._columns(e, i, q, qd, qdd)
            tau[i] = sum((self.value(stem, number) * column for stem, column in columns.items()), Decimal(0))
        return tau, of_links[list(self.elastic)]

    def direct_dynamics(self, q: Array, qd: Array, tau: Array, tau_ext: Array | None = None) -> Array:
        """[qdd_m; qdd_e] (eq. 11), solved as one system of all n + e coordinates; ``tau_ext`` (n) acts on the links."""
        n, size = self.dof, self.dof + len(self.elastic)
        at_rest, _ = self.inverse_dynamics(q, qd, zeros(size))
        drive = tau.copy()
        for e, (i, number) in enumerate(self.elastic.items()):
            drive[i] = -self.value("k", number) * self.wound(number, q[n + e])
        motors = {number: self.value("Iam", number) for number in self.elastic.values()}

        def solved(M: Array, of_links: Array) -> Array:
            moving = of_links if tau_ext is None else of_links + tau_ext
            left, right = zeros(size, size), zeros(size)
            left[:n, :n] = M
            left[:n, n:] = M[:, list(self.elastic)]
            right[:n] = moving
            for e, (i, number) in enumerate(self.elastic.items()):
                left[n + e], right[n + e] = left[i], moving[i]
                left[i] = zeros(size)
                left[i, i], right[i] = motors[number], tau[i] - at_rest[i]
            return solve(left, right)

        return self.link.accelerations(self.at_links(q), self.at_links(qd), drive, solved, self.at_links)

    def regressor(self, columns: Sequence[str], q: Array, qd: Array, qdd: Array) -> Array:
        """Rows [tau_mdi (n); tau_e + k q_e] per unit of the named parameters; the last rows vanish on a real motion.

        Names of the motor side (``Iam1``, ``k1``) and of the link side's standard parameters may mix.
        """
        n = self.dof
        known: dict[str, Array] = {}
        for e, (i, number) in enumerate(self.elastic.items()):
            for stem, torque in self._columns(e, i, q, qd, qdd).items():
                column = known[f"{stem}{number}"] = zeros(n + len(self.elastic))
                column[i] = torque
                if stem == "k":
                    column[n + e] = -torque
        of_links = [name for name in columns if name not in known]
        at_links = (self.at_links(q), self.at_links(qd), self.at_links(qdd))
        for name, torques in self.link.columns(of_links, *at_links).items():
            column = known[name] = np.concatenate([torques, torques[list(self.elastic)]])
            column[list(self.elastic)] = Decimal(0)
        return np.stack([known[name] for name in columns], axis=1)

    def wound(self, number: int, qe: Decimal) -> Decimal:
        """What is left of the elongation beyond the backlash, half of it either way."""
        half = self.gaps.get(number, Decimal(0)) / 2
        return qe - half if qe > half else qe + half if qe < -half else Decimal(0)

    def value(self, stem: str, number: int) -> Decimal:
        """A motor-side parameter; zero if it was not given."""
        return self.link.values.get(f"{stem}{number}", Decimal(0))

    def _columns(self, e: int, i: int, q: Array, qd: Array, qdd: Array) -> dict[str, Decimal]:
        """Torque of motor ``i``, the ``e``-th elastic one, per unit of each parameter of eq. 12 (eq. 8, 9)."""
        direction = sign(qd[i]) if self.direction is None else self.direction[i]
        wound = self.wound(self.elastic[i], q[self.dof + e])
        return dict(zip(MOTOR_SIDE, (qdd[i], qd[i], direction, Decimal(1), -wound), strict=True))


def flexible(robot: Robot, link: Rigid) -> Flexible:
    """``robot`` with springs on its elastic joints; ``link`` is the same robot, rigid."""
    elastic = {i: joint.number for i, joint in enumerate(robot.moving) if joint.number in robot.flexible}
    uses = [use for use in robot.effects if use.effect == "joint_elasticity" and "gap" in use.values]
    gaps = {number: exact(use.values["gap"].value) for use in uses for number in use.joints}
    # Past the spring nothing turns with a rotor.
    effects = tuple(
        replace(effect, shape={**effect.shape, "rotor": Decimal(0)})
        if effect.coordinate in elastic and "rotor" in effect.shape
        else effect
        for effect in link.effects
    )
    return Flexible(replace(link, effects=effects), elastic, gaps)
