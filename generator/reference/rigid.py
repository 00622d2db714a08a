"""The rigid robot: bodies, payload, wrench and effects together (report section 2.1)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import cached_property
from itertools import product

import numpy as np

from generator.reference import balancers, lagrange
from generator.reference.arithmetic import Array, decimals, solve, zeros
from generator.reference.chain import Chain, build
from generator.reference.joint_effects import Acting, Beside, acting
from generator.reference.matter import INERTIAL, of_body, pseudo_inertia
from generator.reference.motion import jacobian, poses
from generator.robot.description import Robot


@dataclass(frozen=True)
class Rigid:
    """A robot with ``values`` of its standard parameters by name; ``matter`` is its pseudo-inertias by frame number.

    ``held`` is the torque (n) of a wrench that the tool exerts, ``warmth`` that of the drives (n), ``states`` those of
    the effects, joint by joint in alphabetical order, zero if there are none.
    """

    chain: Chain
    matter: Mapping[int, Array]
    effects: tuple[Acting, ...]
    values: Mapping[str, Decimal]
    held: Array
    warmth: Array
    states: tuple[Decimal, ...] = ()

    def holding(self, held: Array) -> Rigid:
        """The same robot while its tool exerts a wrench, whose torques (n) are ``held``."""
        return replace(self, held=held)

    def loaded(self, payload: Array) -> Rigid:
        """The same robot with a payload, ten inertial parameters in the tool frame (report eq. 50)."""
        tool, load = self.chain.tool, pseudo_inertia(dict(zip(INERTIAL, payload, strict=True)))
        return replace(self, matter={**self.matter, tool: self.matter.get(tool, zeros(4, 4)) + load})

    def sliding(self, direction: Array) -> Rigid:
        """The same robot with ``direction`` (n) in the place of sign(qd)."""
        return replace(self, effects=tuple(effect.sliding(direction[effect.coordinate]) for effect in self.effects))

    def inverse_dynamics(self, q: Array, qd: Array, qdd: Array) -> Array:
        """Tau = M(q) qdd + H(q, qd) (n) (report eq. 2)."""
        of_bodies = self._of_bodies(q, qd, qdd)
        beside = self._under(self._loading(of_bodies, q, qd, qdd))
        return of_bodies + self._of_effects(self.effects, q, qd, qdd, beside)

    def effect_rates(self, q: Array, qd: Array) -> Array:
        """Time derivatives of the effects' states."""
        beside = self._beside(q, qd, zeros(self.chain.dof))
        rates = {name: rate for effect in self.effects for name, rate in effect.rates(q, qd, beside).items()}
        return np.array([rates[name] for name in self._state_names], dtype=object)

    def load(self, q: Array, qd: Array, qdd: Array) -> Array:
        """What loads the drives (n): bodies, rotors, balancers, springs, ripple, offsets, the tool's wrench."""
        return self._loading(self._of_bodies(q, qd, qdd), q, qd, qdd)

    def bias(self, q: Array, qd: Array) -> Array:
        """H(q, qd) (n): the torque without acceleration."""
        return self.inverse_dynamics(q, qd, zeros(self.chain.dof))

    def gravity(self, q: Array) -> Array:
        """Torque that holds the bodies' weight (n), without balancers and offsets."""
        return lagrange.gravity(self.chain, self.matter, q)

    def inertia_matrix(self, q: Array) -> Array:
        """M(q) (n x n) with the rotors' inertias."""
        M: Array = lagrange.inertia_matrix(self.chain, self.matter, q) + self._rotors
        return M

    def direct_dynamics(self, q: Array, qd: Array, tau: Array) -> Array:
        """Qdd (n) of M qdd = tau - H (report eq. 6)."""
        return self.accelerations(q, qd, tau, solve, lambda qdd: qdd)

    def accelerations(
        self, q: Array, qd: Array, tau: Array, solved: Callable[[Array, Array], Array], seen: Callable[[Array], Array]
    ) -> Array:
        """What ``solved`` makes of M (n x n) and of M qdd (n), which torques tau of the drives leave for the robot.

        Friction by load goes with the size of L - r qdd, qdd (n) being what is ``seen`` in it. All signs are tried;
        those are right that come out.
        """
        still = zeros(self.chain.dof)
        held, M = self.load(q, qd, still), self.inertia_matrix(q)
        rest = [effect for effect in self.effects if not (effect.law.loads or effect.law.by_load)]
        supplied = tau - self._of_effects(rest, q, qd, still, self._under(held))
        slopes = self._rubbing(q, qd, still + Decimal(1))
        rotors = self._unloaded
        for signs in product((Decimal(1), Decimal(-1)), repeat=self.chain.dof):
            if any(sign < 0 and not slope for sign, slope in zip(signs, slopes, strict=True)):
                continue
            share = 1 / (1 + slopes * np.array(signs, dtype=object))
            qdd = solved(M - np.diag(rotors * (1 - share)), share * supplied - held)
            carried = supplied - rotors * seen(qdd)
            if all(not slope or sign * one >= 0 for sign, one, slope in zip(signs, carried, slopes, strict=True)):
                return qdd
        raise ArithmeticError("friction by load of a whole load or more")

    def wrench_torque(self, q: Array, wrench: Array) -> Array:
        """J^T w (n): holds the wrench (force, moment) of the tool on its environment, in the tool frame (eq. 73)."""
        pose = poses(self.chain, q)
        rotation = pose[self.chain.tool][:3, :3]
        in_world = np.concatenate([rotation @ wrench[:3], rotation @ wrench[3:]])
        torques: Array = jacobian(self.chain, pose, self.chain.tool).T @ in_world
        return torques

    def kinetic_energy(self, q: Array, qd: Array) -> Decimal:
        """Of bodies and rotors [J]."""
        of_rotors = (self._weighted(effect.kinetic(qd)) for effect in self.effects)
        return sum(of_rotors, lagrange.kinetic_energy(self.chain, self.matter, q, qd))

    def potential_energy(self, q: Array) -> Decimal:
        """Of weight and balancers [J]; zero at q = 0."""
        start = lagrange.potential_energy(self.chain, self.matter, zeros(self.chain.dof))
        of_effects = (self._weighted(effect.potential(q)) for effect in self.effects)
        return sum(of_effects, lagrange.potential_energy(self.chain, self.matter, q) - start)

    def balancers(self, q: Array) -> dict[int, tuple[Decimal, Decimal, Decimal]]:
        """By joint number: distance r24 of its balancer's pivots [m], force F1 [N] and torque [N m]."""
        result = {}
        for effect in self.effects:
            if pulls := effect.pulls(q):
                x = q[effect.coordinate]
                force, arm = self._weighted(pulls), balancers.lever_arm(effect.shape, x)
                result[effect.number] = balancers.length(effect.shape, x), force, force * arm
        return result

    def regressor(self, columns: Sequence[str], q: Array, qd: Array, qdd: Array) -> Array:
        """Torques per unit of the named standard parameters (n x number of names) (report eq. 3)."""
        found = self.columns(columns, q, qd, qdd)
        return np.stack([found[name] for name in columns], axis=1)

    def columns(self, names: Sequence[str], q: Array, qd: Array, qdd: Array) -> dict[str, Array]:
        """Torques (n) per unit of each named standard parameter; raises KeyError for one that there is not."""
        of_bodies = lagrange.columns(self.chain, self.matter, q, qd, qdd)
        known = {f"{stem}{j}": column for j, found in of_bodies.items() for stem, column in found.items()}
        beside = self._beside(q, qd, qdd)
        for effect in self.effects:
            known |= effect.torques(q, qd, qdd, beside)
        return {name: known[name] for name in names}

    def body_columns(self, number: int, q: Array, qd: Array, qdd: Array) -> dict[str, Array]:
        """Torques (n) per unit of the inertial parameters of a body in frame ``number``, by their stems."""
        return lagrange.columns(self.chain, [number], q, qd, qdd)[number]

    @cached_property
    def _rotors(self) -> Array:
        """What the effects add to the inertia matrix (n x n)."""
        total: Array = zeros(self.chain.dof, self.chain.dof)
        for effect in self.effects:
            if inertia := effect.inertia():
                total = total + self._weighted(inertia) * np.outer(effect.shares, effect.shares)
        return total

    @property
    def _unloaded(self) -> Array:
        """Inertias (n) of the rotors that do not load a gear whose friction goes with the load."""
        result = zeros(self.chain.dof)
        for effect in self.effects:
            if effect.law.by_load:
                result[effect.coordinate] = effect.shape.get("rotor", Decimal(0))
        return result

    def _of_bodies(self, q: Array, qd: Array, qdd: Array) -> Array:
        return lagrange.torque(self.chain, self.matter, q, qd, qdd) + self.held

    def _loading(self, of_bodies: Array, q: Array, qd: Array, qdd: Array) -> Array:
        """The ``load`` (n), where the torque of the bodies is at hand."""
        loading = [effect for effect in self.effects if effect.law.loads]
        return np.asarray(of_bodies + self._rotors @ qdd + self._of_effects(loading, q, qd, qdd))

    def _rubbing(self, q: Array, qd: Array, load: Array) -> Array:
        """Friction (n) that goes with a load."""
        by_load = [effect for effect in self.effects if effect.law.by_load]
        return self._of_effects(by_load, q, qd, zeros(self.chain.dof), self._under(load))

    def _of_effects(
        self, effects: Iterable[Acting], q: Array, qd: Array, qdd: Array, beside: Beside | None = None
    ) -> Array:
        """The torque (n) of some of the effects."""
        torques = (self._torque(effect.torques(q, qd, qdd, beside)) for effect in effects)
        return sum(torques, zeros(self.chain.dof))

    def _beside(self, q: Array, qd: Array, qdd: Array) -> Beside:
        return self._under(self.load(q, qd, qdd))

    def _under(self, load: Array) -> Beside:
        states = self.states or (Decimal(0),) * len(self._state_names)
        return Beside(load, self.warmth, dict(zip(self._state_names, states, strict=True)))

    @property
    def _state_names(self) -> list[str]:
        """Joint by joint, in alphabetical order on each."""
        found = [(effect.number, stem) for effect in self.effects for stem in effect.law.states]
        return [f"{stem}{number}" for number, stem in sorted(found)]

    def _torque(self, columns: Mapping[str, Array]) -> Array:
        """The sum (n) of the parameters times their columns; absent parameters are zero."""
        return sum(
            (self.values[name] * column for name, column in columns.items() if name in self.values),
            zeros(self.chain.dof),
        )

    def _weighted(self, columns: Mapping[str, Decimal]) -> Decimal:
        """The sum of the parameters times their columns; absent parameters are zero."""
        return sum((self.values[name] * column for name, column in columns.items() if name in self.values), Decimal(0))


def rigid(robot: Robot, values: Mapping[str, float]) -> Rigid:
    """``robot`` with standard parameters and lengths by name; absent parameters are zero, absent lengths nominal."""
    given = dict(zip(values, decimals(list(values.values())), strict=True))
    matter = {body.number: of_body(body.number, given) for body in robot.bodies}
    rest = zeros(len(robot.moving))
    return Rigid(build(robot, given), matter, tuple(acting(robot)), given, rest, rest)
