"""Inverse dynamics with few operations: Newton-Euler on segments of parallel axes, in pseudo-inertia form.

Each body works in its own axes or in the unspun axes of its segment, whichever ``Strategy`` says; forces and moments
are summed in the unspun axes, where parallel joints need no rotation between them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from generator.symbolic.bodies import Body
from generator.symbolic.frames import Chain, Frame
from generator.symbolic.gauge import Gauge, Regauged, is_last, regauge
from generator.symbolic.lean_motion import LeanMotion, motions
from generator.symbolic.lean_wrenches import handed_on, in_unspun_axes
from generator.symbolic.matter import Matter, about_z, unspun
from generator.symbolic.newton_euler import Wrench, along_axis
from generator.symbolic.segments import Spun, segments
from generator.symbolic.spin import Turning, added_u, moment, moment_of, turning, turning_tip
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, Nodes, cross, named, zeros
from generator.words import numbered


@dataclass(frozen=True)
class Strategy:
    """How a chain's equations are written: the bodies that work in ``unspun`` axes, and the choice of parameters."""

    unspun: frozenset[int] = frozenset()
    gauge: Gauge = field(default_factory=Gauge)

    def __str__(self) -> str:
        still = f", {numbered('body', self.unspun, 'bodies')} in axes that do not spin" if self.unspun else ""
        return f"segments of parallel axes, pseudo-inertias{still}{self.gauge}"


def inverse_dynamics(chain: Chain, bodies: Mapping[int, Body], qd: Nodes, qdd: Nodes, strategy: Strategy) -> Array:
    """Joint torques of the bodies alone, as ``newton_euler.inverse_dynamics`` gives them."""
    return _Recursion(chain, segments(chain), regauge(chain, bodies, strategy.gauge), strategy, qd, qdd).torques()


@dataclass(frozen=True)
class _Recursion:
    """One pass to the tips and one back."""

    chain: Chain
    spun: Mapping[int, Spun]
    chosen: Regauged
    strategy: Strategy
    qd: Nodes
    qdd: Nodes

    @cached_property
    def motions(self) -> dict[int, LeanMotion]:
        asked = {frame.number: self._asked_rates(frame) for frame in self.chain.frames}
        chosen = self.chosen
        return motions(self.chain, self.spun, chosen.positions, chosen.gravity, self.qd, self.qdd, asked)

    def _asked_rates(self, frame: Frame) -> set[int]:
        """Components 0 and 1 of a frame's angular acceleration that the frames it carries ask for.

        A frame whose axes are the same but for a quarter turn asks for that along its z axis alone.
        """
        asked: set[int] = set()
        for other in self.chain.frames:
            if other.parent is frame and other.has_body() and not self._is_unspun_tip(other):
                link = self.spun[other.number]
                alone = link.quarter and other.revolute
                asked |= {k for k in (0, 1) if not alone or link.entry[k, 2].number != 0}
        return asked

    def _is_unspun_tip(self, frame: Frame) -> bool:
        return frame.revolute and frame.number in self.strategy.unspun and is_last(self.chain, frame)

    def torques(self) -> Array:
        torques = zeros(self.chain.program, self.chain.dof)
        own: dict[int, Wrench] = {}
        summed: dict[int, Wrench] = {}
        for frame in reversed(self.chain.frames):
            j, link = frame.number, self.spun[frame.number]
            apart = self._add_body(frame, own, summed)
            if j in own:
                _add(summed, j, in_unspun_axes(link, own[j]))
            total = summed.get(j)
            if total is not None:
                named("f", j, total.f)
                named("n", j, total.n)
            if frame.coordinate is not None:
                torques[frame.coordinate] = self._torque(frame, total, apart)
            if frame.parent is None:
                continue
            k, position = frame.parent.number, self.chosen.positions[j]
            if total is not None:
                _add(summed if link.continues else own, k, handed_on(link, self.spun[k], position, total))
            if apart is not None:
                _add(own, k, Wrench(link.entry @ apart[1].f, link.entry @ apart[1].n))
        return torques

    def _add_body(self, frame: Frame, own: dict[int, Wrench], summed: dict[int, Wrench]) -> tuple[Node, Wrench] | None:
        """Adds the wrench of a frame's body where it belongs; what ``_apart`` gives of one that is reckoned so."""
        j = frame.number
        part = self.chosen.parts.get(j)
        if part is None:
            return None
        if j not in self.strategy.unspun:
            motion = self.motions[j]
            _add(own, j, _named_wrench("", j, _wrench(turning(motion.own), motion.a_own, part, about_z(part))))
        elif is_second(frame):
            return self._apart(frame, part)
        else:
            _add(summed, j, _named_wrench("u", j, self._unspun_wrench(frame, part)))
        return None

    def _torque(self, frame: Frame, total: Wrench | None, apart: tuple[Node, Wrench] | None) -> Node:
        torque: Node = self.chain.program.zero
        if total is not None:
            torque = along_axis(frame, total)
        return torque if apart is None else torque + apart[0]

    def _unspun_wrench(self, frame: Frame, part: Matter) -> Wrench:
        j = frame.number
        motion = self.motions[j]
        turned = unspun(part, self.spun[j])
        named("Su", j, turned.sigma)
        named("MSu", j, turned.moment)
        rotation = turning(motion.unspun)
        if self._is_unspun_tip(frame) and frame.coordinate is not None:
            rotation = turning_tip(motion.carried, self.qd[frame.coordinate], self.qdd[frame.coordinate])
        return _wrench(rotation, motion.a_unspun, turned, about_z(part))

    def _apart(self, frame: Frame, part: Matter) -> tuple[Node, Wrench]:
        """A body by the antecedent's rotation and its own apart: its torque at its joint, and its wrench at O_a(j).

        With U = U_a + E, P from O_a to O_j, T = S + P MS^T: the moments are vee(U_a T) + MS x a and E's part at O_j,
        vee(U_a (T + MS P^T + M P P^T) + E T^T) + (MS + M P) x a at O_a.
        """
        j = frame.number
        assert frame.coordinate is not None
        motion, link = self.motions[j], self.spun[j]
        turned = unspun(part, link)
        u, a = motion.carried.u, motion.a_carried
        added = added_u(motion.carried, self.qd[frame.coordinate], self.qdd[frame.coordinate])
        p, ms, mass = link.entry.T @ self.chosen.positions[j], turned.moment, part.mass
        t = turned.sigma + np.outer(p, ms)
        about = t + np.outer(ms + mass * p, p)
        torque = moment_of(u, t)[2] + self.qdd[frame.coordinate] * about_z(part) + cross(ms, a)[2]
        arm = ms + mass * p
        n = moment_of(u, about) + moment_of(added, t.T) + cross(arm, a)
        return torque, Wrench(mass * a + u @ arm + added @ ms, n)


def is_second(frame: Frame) -> bool:
    """Whether the antecedent turns about one fixed axis, so that most of its U is zero."""
    return frame.revolute and frame.parent is not None and frame.parent.parent is None and frame.joint.alpha != 0


def _named_wrench(mark: str, j: int, wrench: Wrench) -> Wrench:
    return Wrench(named(f"F{mark}", j, wrench.f), named(f"N{mark}", j, wrench.n))


def _add(wrenches: dict[int, Wrench], j: int, wrench: Wrench) -> None:
    wrenches[j] = wrenches[j] + wrench if j in wrenches else wrench


def _wrench(rotation: Turning, a: Array, part: Matter, inertia_about_z: Node) -> Wrench:
    """F = M a + U MS and N = vee(U S - (U S)^T) + MS x a."""
    force = part.mass * a + rotation.u @ part.moment
    return Wrench(force, moment(rotation, part.sigma, inertia_about_z) + cross(part.moment, a))
