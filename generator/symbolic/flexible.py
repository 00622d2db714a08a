"""Elastic drive trains (report section 2.2): motor side and link side of the reduced model.

q = [q_m; q_e] with one elastic coordinate per elastic joint, q_a = q_m + q_e on the link side. Motors carry inertia and
friction, springs pull with -k q_e, and the links see q_a (eq. 8-11).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from generator.effects.library import Instance
from generator.symbolic import effect_torques
from generator.symbolic.dynamics import Dynamics
from generator.symbolic.effect_torques import JointMotion
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, Nodes, zeros


@dataclass(frozen=True)
class FlexibleDynamics:
    """The rigid model ``link`` at q_a, and the motors of the elastic joints.

    ``q``, ``qd``, ``qdd`` are the stacked coordinates (n + number of elastic joints); ``elastic`` the coordinates of
    the elastic joints in order; ``parameters`` holds Iam, Fvm, Fcm, Offm, k by name.
    """

    link: Dynamics
    motor_effects: Sequence[Instance]
    parameters: Mapping[str, Node]
    elastic: tuple[int, ...]
    q: Nodes
    qd: Nodes
    qdd: Nodes

    @property
    def dof(self) -> int:
        """Number of moving joints n: the size of q_m."""
        return self.link.chain.dof

    @cached_property
    def motor_motion(self) -> JointMotion:
        """Motion of the motors: q_m on every joint, and the elongations q_e."""
        n = self.dof
        moving = self.link.chain.robot.moving
        elongation = {moving[joint].number: self.q[n + k] for k, joint in enumerate(self.elastic)}
        return JointMotion(self.q[:n], self.qd[:n], self.qdd[:n], elongation)

    def inverse_dynamics(self) -> tuple[Array, Array]:
        """tau_mdi (n) and tau_e = M(q_a) qdd_a + H(q_a, qd_a) on the elastic joints (eq. 8, 10).

        On a real motion tau_e = -k q_e. A rigid joint's tau_mdi is its link-side torque.
        """
        of_links = self.link.inverse_dynamics()
        tau = np.array(of_links, dtype=object)
        of_motors = self._motors(self.motor_motion)
        for joint in self.elastic:
            tau[joint] = of_motors[joint]
        return tau, of_links[list(self.elastic)]

    def direct_dynamics(self, tau: Nodes, tau_ext: Nodes | None = None) -> Array:
        """[qdd_m; qdd_e] from the motor torques tau (n) (eq. 11) and torques tau_ext (n) of others on the links."""
        n = self.dof
        chain = self.link.chain
        still = [chain.program.zero] * n
        held = self._motors(JointMotion(self.q[:n], self.qd[:n], still, self.motor_motion.elongation))
        drive = np.array(tau, dtype=object)
        for joint in self.elastic:
            drive[joint] = self._spring(joint)
        of_links = self.link.direct_dynamics(drive, others=tau_ext)
        of_motors = np.array(of_links, dtype=object)
        inertia = effect_torques.inertia(chain, self.motor_effects, self.motor_motion, self.parameters)
        for joint in self.elastic:
            of_motors[joint] = (tau[joint] - held[joint]) / inertia[joint, joint]
        elongations = [of_links[joint] - of_motors[joint] for joint in self.elastic]
        return np.array([*of_motors, *elongations], dtype=object)

    def regressor_columns(self, link_names: Sequence[str], motor_names: Sequence[str]) -> dict[str, dict[int, Node]]:
        """Columns by parameter over the rows [tau_mdi (n); tau_e + k q_e (elastic joints)].

        The second block is the torque balance of the links; it is zero on a real motion, so that both blocks are linear
        in the parameters, k included (eq. 10-13).
        """
        n = self.dof
        balance = {joint: n + k for k, joint in enumerate(self.elastic)}
        result = {}
        for name, column in self.link.regressor_columns(link_names).items():
            result[name] = {balance.get(row, row): entry for row, entry in column.items()}
        of_motors = effect_torques.columns(self.link.chain, self.motor_effects, self.motor_motion)
        springs = [instance for instance in self.motor_effects if "qe" in instance.effect.needs]
        stiffness = {name for instance in springs for name in instance.names}
        for name in motor_names:
            column = dict(of_motors[name])
            if name in stiffness:
                column |= {balance[row]: -entry for row, entry in column.items()}
            result[name] = column
        return result

    def _motors(self, motion: JointMotion) -> Array:
        """Torque of the motors' own effects, the springs' pull included."""
        if not self.motor_effects:
            return zeros(self.link.chain.program, self.dof)
        return effect_torques.torques(self.link.chain, self.motor_effects, motion, self.parameters)

    def _spring(self, joint: int) -> Node:
        """-k q_e, the torque that an elastic joint receives from its spring (eq. 7)."""
        springs = [instance for instance in self.motor_effects if "qe" in instance.effect.needs]
        motion = self.motor_motion
        pull: Node = effect_torques.torques(self.link.chain, springs, motion, self.parameters)[joint]
        return pull
