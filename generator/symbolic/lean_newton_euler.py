"""Inverse dynamics with few operations: Newton-Euler on segments of parallel axes, in pseudo-inertia form.

Each body works in its own axes or in the unspun axes of its segment, whichever ``Strategy`` says; forces and moments
are summed in the unspun axes, where parallel joints need no rotation between them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from generator.symbolic.bodies import Body
from generator.symbolic.frames import Chain, Frame
from generator.symbolic.gauge import Gauge, Regauged, regauge
from generator.symbolic.matter import Matter, about_z, unspun
from generator.symbolic.newton_euler import Motion, Wrench
from generator.symbolic.segments import Spun, segments
from generator.symbolic.spin import Spin, entered, in_own_axes, moment, standing, with_rate
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
    """Motion of a frame: rotation in unspun and own axes, acceleration of the origin in unspun and own axes."""

    unspun: Spin
    own: Spin
    a_unspun: Array
    a_own: Array


def inverse_dynamics(chain: Chain, bodies: Mapping[int, Body], qd: Nodes, qdd: Nodes, strategy: Strategy) -> Array:
    """Joint torques of the bodies alone, as ``newton_euler.inverse_dynamics`` gives them."""
    spun = segments(chain)
    chosen = regauge(chain, bodies, strategy.gauge)
    motion = _motions(chain, spun, chosen.positions, qd, qdd)
    return _torques(chain, spun, chosen, motion, strategy)


def own_motions(chain: Chain, positions: Mapping[int, Array], qd: Nodes, qdd: Nodes) -> dict[int, Motion]:
    """Motion of every frame in its own axes, as ``newton_euler.motions`` gives it, for origins at ``positions``."""
    motion = _motions(chain, segments(chain), positions, qd, qdd)
    return {j: Motion(own.own.w, own.own.wd, own.own.u, own.a_own) for j, own in motion.items()}


def _motions(
    chain: Chain, spun: Mapping[int, Spun], positions: Mapping[int, Array], qd: Nodes, qdd: Nodes
) -> dict[int, LeanMotion]:
    program = chain.program
    result: dict[int, LeanMotion] = {}
    for frame in chain.frames:
        j, link = frame.number, spun[frame.number]
        carried, a = _carried(chain, frame, link, positions[j], spun, result)
        if frame.coordinate is None:
            rotation = carried
        elif frame.revolute:
            rotation = with_rate(carried, qd[frame.coordinate], qdd[frame.coordinate])
        else:
            rotation = carried
            slide = array(program, [0, 0, qd[frame.coordinate]])
            a = a + 2 * cross(carried.w, slide) + array(program, [0, 0, qdd[frame.coordinate]])
        own = in_own_axes(rotation, link) if frame.revolute else _turned_by(rotation, link)
        _named_motion(j, rotation, own)
        result[j] = LeanMotion(rotation, own, named("VPu", j, a), named("VP", j, link.to_own(a)))
    return result


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


def _carried(
    chain: Chain,
    frame: Frame,
    link: Spun,
    position: Array,
    spun: Mapping[int, Spun],
    result: Mapping[int, LeanMotion],
) -> tuple[Spin, Array]:
    """Rotation of the antecedent and acceleration of the frame's origin, in the frame's unspun axes."""
    if frame.parent is None:
        return entered(link, standing(chain.program)), link.entry.T @ -chain.gravity
    before = result[frame.parent.number]
    if link.continues:
        arm = spun[frame.parent.number].to_unspun(position)
        return before.unspun, before.a_unspun + before.unspun.u @ arm
    return entered(link, before.own), link.entry.T @ (before.a_own + before.own.u @ position)


def _torques(
    chain: Chain,
    spun: Mapping[int, Spun],
    chosen: Regauged,
    motion: Mapping[int, LeanMotion],
    strategy: Strategy,
) -> Array:
    program = chain.program
    torques = zeros(program, chain.dof)
    own: dict[int, Wrench] = {}
    summed: dict[int, Wrench] = {}
    for frame in reversed(chain.frames):
        j, link = frame.number, spun[frame.number]
        part = chosen.parts.get(j)
        if part is not None:
            if j in strategy.unspun:
                turned = unspun(part, link)
                named("Su", j, turned.sigma)
                named("MSu", j, turned.moment)
                wrench = _wrench(motion[j].unspun, motion[j].a_unspun, turned, about_z(part))
                _add(summed, j, _named_wrench("u", j, wrench))
            else:
                wrench = _wrench(motion[j].own, motion[j].a_own, part, about_z(part))
                _add(own, j, _named_wrench("", j, wrench))
        if j in own:
            _add(summed, j, Wrench(link.to_unspun(own[j].f), link.to_unspun(own[j].n)))
        if j not in summed:
            continue
        total = summed[j]
        named("f", j, total.f)
        named("n", j, total.n)
        if frame.coordinate is not None:
            torques[frame.coordinate] = total.n[2] if frame.revolute else total.f[2]
        if frame.parent is None:
            continue
        position = chosen.positions[j]
        if link.continues:
            arm = spun[frame.parent.number].to_unspun(position)
            _add(summed, frame.parent.number, Wrench(total.f, total.n + cross(arm, total.f)))
        else:
            f = link.entry @ total.f
            _add(own, frame.parent.number, Wrench(f, link.entry @ total.n + cross(position, f)))
    return torques


def _named_wrench(mark: str, j: int, wrench: Wrench) -> Wrench:
    return Wrench(named(f"F{mark}", j, wrench.f), named(f"N{mark}", j, wrench.n))


def _add(wrenches: dict[int, Wrench], j: int, wrench: Wrench) -> None:
    wrenches[j] = wrenches[j] + wrench if j in wrenches else wrench


def _wrench(spin: Spin, a: Array, part: Matter, inertia_about_z: Node) -> Wrench:
    """F = M a + U MS and N = vee(U S - (U S)^T) + MS x a."""
    force = part.mass * a + spin.u @ part.moment
    return Wrench(force, moment(spin, part.sigma, inertia_about_z) + cross(part.moment, a))
