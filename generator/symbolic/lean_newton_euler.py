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
from generator.symbolic.gauge import Gauge, Origins, Regauged, is_last, regauge
from generator.symbolic.matter import Matter, about_z, unspun
from generator.symbolic.newton_euler import Motion, Wrench
from generator.symbolic.segments import Spun, segments
from generator.symbolic.spin import (
    Spin,
    Turning,
    added_u,
    entered,
    in_own_axes,
    moment,
    moment_of,
    standing,
    turning,
    turning_tip,
    with_rate,
)
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, Nodes, array, cross, named, zeros


@dataclass(frozen=True)
class Strategy:
    """How a chain's equations are written: the bodies that work in ``unspun`` axes, and the choice of parameters."""

    unspun: frozenset[int] = frozenset()
    gauge: Gauge = field(default_factory=Gauge)

    def __str__(self) -> str:
        still = f", bodies {', '.join(map(str, sorted(self.unspun)))} in axes that do not spin" if self.unspun else ""
        return f"segments of parallel axes, pseudo-inertias{still}{self.gauge}"


@dataclass(frozen=True)
class LeanMotion:
    """Motion of a frame: rotation in unspun and own axes, acceleration of the origin in unspun and own axes.

    ``carried`` is the antecedent's rotation and ``a_carried`` the acceleration of its origin, in unspun axes.
    """

    carried: Spin
    a_carried: Array
    unspun: Spin
    own: Spin
    a_unspun: Array
    a_own: Array


def inverse_dynamics(chain: Chain, bodies: Mapping[int, Body], qd: Nodes, qdd: Nodes, strategy: Strategy) -> Array:
    """Joint torques of the bodies alone, as ``newton_euler.inverse_dynamics`` gives them."""
    return _Recursion(chain, segments(chain), regauge(chain, bodies, strategy.gauge), strategy, qd, qdd).torques()


def own_motions(chain: Chain, origins: Origins, qd: Nodes, qdd: Nodes) -> dict[int, Motion]:
    """Motion of every frame in its own axes, as ``newton_euler.motions`` gives it, for origins put elsewhere."""
    nothing = Regauged({}, origins.positions, chain.gravity)
    motion = _Recursion(chain, segments(chain), nothing, Strategy(), qd, qdd).motions
    return {j: Motion(own.own.w, own.own.wd, own.own.u, own.a_own) for j, own in motion.items()}


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
        program = self.chain.program
        result: dict[int, LeanMotion] = {}
        for frame in self.chain.frames:
            j, link = frame.number, self.spun[frame.number]
            carried, a_carried, a = self._carried(frame, result)
            rotation = carried
            if frame.coordinate is not None:
                rate, acceleration = self.qd[frame.coordinate], self.qdd[frame.coordinate]
                if frame.revolute:
                    rotation = with_rate(carried, rate, acceleration)
                else:
                    slide = array(program, [0, 0, rate])
                    a = a + 2 * cross(carried.w, slide) + array(program, [0, 0, acceleration])
            if frame.revolute:
                own = in_own_axes(rotation, link, self._hands_rates_on(frame))
            else:
                own = _turned_by(rotation, link)
            _named_motion(j, rotation, own)
            a, a_own = named("VPu", j, a), named("VP", j, link.to_own(a))
            result[j] = LeanMotion(carried, a_carried, rotation, own, a, a_own)
        return result

    def _carried(self, frame: Frame, result: Mapping[int, LeanMotion]) -> tuple[Spin, Array, Array]:
        """In the frame's unspun axes, the antecedent's rotation and the acceleration of its origin and of the frame's."""
        link = self.spun[frame.number]
        if frame.parent is None:
            a = link.entry.T @ -self.chosen.gravity
            return entered(link, standing(self.chain.program)), a, a
        before = result[frame.parent.number]
        position = self.chosen.positions[frame.number]
        if link.continues:
            arm = self.spun[frame.parent.number].to_unspun(position)
            return before.unspun, before.a_unspun, before.a_unspun + before.unspun.u @ arm
        a_carried, a = link.entry.T @ before.a_own, link.entry.T @ (before.a_own + before.own.u @ position)
        return entered(link, before.own), a_carried, a

    def _hands_rates_on(self, frame: Frame) -> bool:
        """Whether a frame that this one carries asks for its angular acceleration."""
        if not self.chosen.parts:
            return True
        carried = [other for other in self.chain.frames if other.parent is frame and other.has_body()]
        return not all(self._is_unspun_tip(other) for other in carried)

    def _is_unspun_tip(self, frame: Frame) -> bool:
        return frame.revolute and frame.number in self.strategy.unspun and is_last(self.chain, frame)

    def torques(self) -> Array:
        torques = zeros(self.chain.program, self.chain.dof)
        own: dict[int, Wrench] = {}
        summed: dict[int, Wrench] = {}
        for frame in reversed(self.chain.frames):
            j, link = frame.number, self.spun[frame.number]
            part = self.chosen.parts.get(j)
            apart: tuple[Node, Wrench] | None = None
            if part is not None:
                if j in self.strategy.unspun and is_second(frame):
                    apart = self._apart(frame, part)
                elif j in self.strategy.unspun:
                    _add(summed, j, _named_wrench("u", j, self._unspun_wrench(frame, part)))
                else:
                    motion = self.motions[j]
                    wrench = _wrench(turning(motion.own), motion.a_own, part, about_z(part))
                    _add(own, j, _named_wrench("", j, wrench))
            if j in own:
                _add(summed, j, Wrench(link.to_unspun(own[j].f), link.to_unspun(own[j].n)))
            total = summed.get(j)
            if total is not None:
                named("f", j, total.f)
                named("n", j, total.n)
                if frame.coordinate is not None:
                    torques[frame.coordinate] = total.n[2] if frame.revolute else total.f[2]
            if apart is not None:
                torques[frame.coordinate] = torques[frame.coordinate] + apart[0]
            if frame.parent is None:
                continue
            k, position = frame.parent.number, self.chosen.positions[j]
            if total is not None and link.continues:
                arm = self.spun[k].to_unspun(position)
                _add(summed, k, Wrench(total.f, total.n + cross(arm, total.f)))
            elif total is not None:
                f = link.entry @ total.f
                _add(own, k, Wrench(f, link.entry @ total.n + cross(position, f)))
            if apart is not None:
                _add(own, k, Wrench(link.entry @ apart[1].f, link.entry @ apart[1].n))
        return torques

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


def _named_motion(j: int, unspun_rotation: Spin, own: Spin) -> None:
    """Names for a reviewer; a u marks unspun axes."""
    for mark, rotation in (("", own), ("u", unspun_rotation)):
        named(f"W{mark}", j, rotation.w)
        named(f"WP{mark}", j, rotation.wd)
        named(f"U{mark}", j, rotation.u)


def _turned_by(rotation: Spin, link: Spun) -> Spin:
    """The rotation of a frame that does not spin in its own axes, which a constant angle turns."""
    zero, one = link.cosine.program.zero, link.cosine.program.one
    c, s = link.cosine, link.sine
    return rotation.turned(np.array([[c, -s, zero], [s, c, zero], [zero, zero, one]], dtype=object))


def _named_wrench(mark: str, j: int, wrench: Wrench) -> Wrench:
    return Wrench(named(f"F{mark}", j, wrench.f), named(f"N{mark}", j, wrench.n))


def _add(wrenches: dict[int, Wrench], j: int, wrench: Wrench) -> None:
    wrenches[j] = wrenches[j] + wrench if j in wrenches else wrench


def _wrench(rotation: Turning, a: Array, part: Matter, inertia_about_z: Node) -> Wrench:
    """F = M a + U MS and N = vee(U S - (U S)^T) + MS x a."""
    force = part.mass * a + rotation.u @ part.moment
    return Wrench(force, moment(rotation, part.sigma, inertia_about_z) + cross(part.moment, a))
