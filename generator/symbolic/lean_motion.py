"""Motion of the frames with few operations: each in own and in unspun axes, on segments of parallel axes."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np

from generator.symbolic.frames import Chain
from generator.symbolic.gauge import Origins
from generator.symbolic.newton_euler import Motion
from generator.symbolic.segments import Spun, segments
from generator.symbolic.spin import Spin, entered, in_own_axes, standing, with_rate
from generator.symbolic.vectors import Array, Nodes, array, cross, named


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


def own_motions(chain: Chain, origins: Origins, qd: Nodes, qdd: Nodes) -> dict[int, Motion]:
    """Motion of every frame in its own axes, as ``newton_euler.motions`` gives it, for origins put elsewhere."""
    motion = motions(chain, segments(chain), origins.positions, chain.gravity, qd, qdd)
    return {j: Motion(own.own.w, own.own.wd, own.own.u, own.a_own, own.own.differences) for j, own in motion.items()}


def motions(
    chain: Chain,
    spun: Mapping[int, Spun],
    positions: Mapping[int, Array],
    gravity: Array,
    qd: Nodes,
    qdd: Nodes,
    asked: Mapping[int, Collection[int]] | None = None,
) -> dict[int, LeanMotion]:
    """Motion of every frame, for origins at ``positions`` in their antecedents and free fall ``gravity`` in frame 0.

    ``asked`` are the components 0 and 1 of the angular acceleration that anything asks of each frame; default all.
    """
    program = chain.program
    result: dict[int, LeanMotion] = {}
    for frame in chain.frames:
        j, link = frame.number, spun[frame.number]
        if frame.parent is None:
            carried, a = entered(link, standing(program)), link.entry.T @ -gravity
            a_carried = a
        else:
            carried, a_carried, a = _carried(link, spun[frame.parent.number], positions[j], result)
        rotation = carried
        if frame.coordinate is not None:
            rate, acceleration = qd[frame.coordinate], qdd[frame.coordinate]
            if frame.revolute:
                rotation = with_rate(carried, rate, acceleration)
            else:
                slide = array(program, [0, 0, rate])
                a = a + 2 * cross(carried.w, slide) + array(program, [0, 0, acceleration])
        if frame.revolute:
            own = in_own_axes(rotation, link, (0, 1) if asked is None else asked[j])
        else:
            own = _turned_by(rotation, link)
        _named_motion(j, rotation, own)
        a, a_own = named("VPu", j, a), named("VP", j, link.to_own(a))
        result[j] = LeanMotion(carried, a_carried, rotation, own, a, a_own)
    return result


def _carried(link: Spun, below: Spun, position: Array, result: Mapping[int, LeanMotion]) -> tuple[Spin, Array, Array]:
    """The antecedent's rotation and the accelerations of its origin and of the frame's, in the frame's unspun axes."""
    before = result[below.frame.number]
    if link.continues:
        return before.unspun, before.a_unspun, before.a_unspun + before.unspun.u @ below.to_unspun(position)
    a_carried, a = link.entry.T @ before.a_own, link.entry.T @ (before.a_own + before.own.u @ position)
    return entered(link, before.own), a_carried, a


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
