"""The dynamic models of one chain for one choice of parameters: each model of report section 2.1, once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import sympy

from generator.effects.library import Instance
from generator.symbolic import effect_torques, newton_euler, regressor, strategy
from generator.symbolic.bodies import Body, bodies
from generator.symbolic.direct import solve
from generator.symbolic.effect_torques import JointMotion
from generator.symbolic.frames import Chain, Frame
from generator.symbolic.kinematics import velocities
from generator.symbolic.lowering import lower
from generator.symbolic.newton_euler import Wrench
from generator.symbolic.statements import Node
from generator.symbolic.strategy import TEXTBOOK, Strategies
from generator.symbolic.under_load import accelerations
from generator.symbolic.vectors import Array, Nodes, cross, dot, zeros


@dataclass(frozen=True)
class Dynamics:
    """A chain with its effects, at joint speeds ``qd`` and accelerations ``qdd`` (n each).

    ``parameters`` maps the standard names of the parameters that are kept to their nodes; what is absent is zero.
    ``strategies`` says how the equations are written. ``payload`` is one more body, in the tool frame (report eq. 50).
    """

    chain: Chain
    effects: Sequence[Instance]
    parameters: Mapping[str, Node]
    qd: Nodes
    qdd: Nodes
    payload: Body | None = None
    strategies: Strategies = TEXTBOOK

    @cached_property
    def matter(self) -> dict[int, Body]:
        """The bodies by frame number, the payload on the tool frame."""
        program = self.chain.program
        frames = [frame.number for frame in self.chain.frames if frame.has_body()]
        result = bodies(program, self.parameters, frames)
        if self.payload is not None:
            j = self.chain.tool.number
            result[j] = result[j] + self.payload if j in result else self.payload
        return result

    @cached_property
    def still(self) -> list[Node]:
        """Zeros (n): speeds or accelerations of a robot that has none."""
        return [self.chain.program.zero] * self.chain.dof

    def joint_motion(self, qd: Nodes, qdd: Nodes, load: Array | None = None) -> JointMotion:
        """What the effects see; the ``load`` (n) of the joints where it is given."""
        others = effect_torques.inputs(self.chain, self.effects)
        if load is not None:
            others |= {f"load{joint.number}": load[k] for k, joint in enumerate(self.chain.robot.moving)}
        return JointMotion(self._positions, qd, qdd, {}, others)

    @property
    def _positions(self) -> list[Node]:
        return [self.chain.values[joint.variable] for joint in self.chain.robot.moving]

    def inverse_dynamics(self, wrench: Wrench | None = None) -> Array:
        """tau = M(q) qdd + H(q, qd) (report eq. 2), and the torque that holds a wrench of the tool (eq. 73)."""
        return self._torques(self.qd, self.qdd, wrench)

    @cached_property
    def bias(self) -> Array:
        """H(q, qd): the torque without acceleration."""
        return self._torques(self.qd, self.still, None)

    @cached_property
    def gravity(self) -> Array:
        """Torque of the bodies' weight alone; balancers and offsets are effects and are not in it."""
        return strategy.gravity(self.chain, self.matter, self.strategies.gravity)

    @cached_property
    def gravity_beside_inertia(self) -> Array:
        """The same torques, written to share the composite bodies of the inertia matrix."""
        return strategy.gravity(self.chain, self.matter, self.strategies.gravity_beside_inertia)

    @cached_property
    def inertia_matrix(self) -> Array:
        """M(q) with the rotors' inertias (report eq. 2, 5)."""
        motion = self.joint_motion(self.qd, self.still)
        rotors = effect_torques.inertia(self.chain, self.effects, motion, self.parameters)
        return strategy.inertia_matrix(self.chain, self.matter, self.strategies.inertia) + rotors

    def direct_dynamics(self, tau: Nodes, wrench: Wrench | None = None, others: Nodes | None = None) -> Array:
        """qdd from tau, and from torques of ``others`` on the links (report eq. 6)."""
        drive = np.array(tau, dtype=object)
        rest = zeros(self.chain.program, self.chain.dof) if others is None else np.array(others, dtype=object)
        if self._reads_load:
            held = self._loading(self._of_bodies(self.qd, self.still, wrench), self.qd, self.still)
            supplied = drive - self._own_friction
            return accelerations(self.inertia_matrix, supplied, rest - held, *self._rubbing)
        held = self.bias if wrench is None else self._torques(self.qd, self.still, wrench)
        return solve(self.inertia_matrix, drive + rest - held)

    @cached_property
    def effect_rates(self) -> Array:
        """Time derivatives of the effects' states."""
        motion = self.joint_motion(self.qd, self.still)
        return np.array(effect_torques.rates(self.chain, self.effects, motion), dtype=object)

    @cached_property
    def kinetic_energy(self) -> Node:
        """Kinetic energy of bodies and rotors [J]."""
        program = self.chain.program
        velocity = velocities(self.chain, self.qd)
        twice = program.zero
        for j, part in self.matter.items():
            w, v = velocity[j].w, velocity[j].v
            momentum = part.mass * v + 2 * cross(w, part.moment)
            twice = twice + w @ (part.inertia @ w) + v @ momentum
        motion = self.joint_motion(self.qd, self.still)
        rotors = effect_torques.energy(self.chain, self.effects, "kinetic_energy", motion, self.parameters)
        kinetic: Node = twice / 2 + rotors
        return kinetic

    @cached_property
    def height_energy(self) -> Node:
        """Potential energy of the bodies' weight [J], up to a constant."""
        return -dot(self.chain.gravity, self._moment_at_base())

    @cached_property
    def effect_energy(self) -> Node:
        """Potential energy that effects store [J], zero at q = 0."""
        motion = self.joint_motion(self.still, self.still)
        return effect_torques.energy(self.chain, self.effects, "potential_energy", motion, self.parameters)

    def regressor_columns(self, names: Iterable[str]) -> dict[str, dict[int, Node]]:
        """Columns of the regressor (report eq. 3) by standard parameter, each {coordinate: entry}."""
        wanted = list(names)
        load = self._loading(self._of_bodies(self.qd, self.qdd), self.qd, self.qdd) if self._reads_load else None
        seen = self.joint_motion(self.qd, self.qdd, load)
        found = dict(effect_torques.columns(self.chain, self.effects, seen))
        found |= regressor.columns(self.chain, wanted, self.qd, self.qdd, self.strategies.regressor)
        return {name: found[name] for name in wanted}

    def _torques(self, qd: Nodes, qdd: Nodes, wrench: Wrench | None) -> Array:
        of_bodies = self._of_bodies(qd, qdd, wrench)
        load = self._loading(of_bodies, qd, qdd) if self._reads_load else None
        seen = self.joint_motion(qd, qdd, load)
        return of_bodies + effect_torques.torques(self.chain, self.effects, seen, self.parameters)

    def _of_bodies(self, qd: Nodes, qdd: Nodes, wrench: Wrench | None = None) -> Array:
        """Torque of the bodies, and what holds a wrench of the tool."""
        if wrench is None:
            return strategy.torques(self.chain, self.matter, qd, qdd, self.strategies.torque)
        motion = newton_euler.motions(self.chain, qd, qdd)
        return newton_euler.inverse_dynamics(self.chain, motion, self.matter, wrench)

    @property
    def _reads_load(self) -> bool:
        return effect_torques.reads(self.effects, "load")

    def _loading(self, of_bodies: Array, qd: Nodes, qdd: Nodes) -> Array:
        """The load of each drive (n): ``of_bodies``, effects that store energy, offsets, and rotors."""
        seen = self.joint_motion(qd, qdd)
        parts = [one for one in self.effects if one.effect.loads]
        of_effects = effect_torques.torques(self.chain, parts, seen, self.parameters)
        rotors = effect_torques.inertia(self.chain, self.effects, seen, self.parameters)
        load: Array = of_bodies + of_effects + rotors @ np.array(qdd, dtype=object)
        return load

    @property
    def _own_friction(self) -> Array:
        """Torque (n) of all that is neither load nor goes with it."""
        own = [one for one in self.effects if not one.effect.loads and "load" not in one.effect.needs]
        return effect_torques.torques(self.chain, own, self.joint_motion(self.qd, self.still), self.parameters)

    @property
    def _rubbing(self) -> tuple[Array, Array]:
        """Friction of each joint per unit of its load, and the inertia of the rotor that loads nothing (n each)."""
        program, by_load = self.chain.program, [one for one in self.effects if "load" in one.effect.needs]
        unit = np.array([program.constant(1)] * self.chain.dof, dtype=object)
        seen = self.joint_motion(self.qd, self.still, unit)
        rotors = zeros(program, self.chain.dof)
        for one in by_load:
            coordinate = self.chain.robot.moving.index(one.joint)
            rotors[coordinate] = lower(program, one.site.values.get("rotor", sympy.S.Zero), {})
        return effect_torques.torques(self.chain, by_load, seen, self.parameters), rotors

    def _moment_at_base(self) -> Array:
        """First moment of all matter about O_0, in frame 0 [kg m]."""
        program = self.chain.program
        total = zeros(program, 3)
        carried: dict[int, Body] = dict(self.matter)
        for frame in reversed(self.chain.frames):
            part = carried.get(frame.number)
            if part is None:
                continue
            below = _first_moment(part, frame)
            if frame.parent is None:
                total = total + below.moment
            else:
                held = carried.get(frame.parent.number)
                carried[frame.parent.number] = below if held is None else held + below
        return total


def _first_moment(part: Body, frame: Frame) -> Body:
    """Mass and first moment seen from the antecedent; the tensor is left as nothing."""
    moment = frame.rotation @ part.moment + part.mass * frame.position
    return Body(zeros(part.mass.program, 3, 3), moment, part.mass)
