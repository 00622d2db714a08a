"""Inertia matrix with few operations: composite bodies in pseudo-inertia form, and screws that meet their wrenches.

A composite body is summed in own axes, turned once into the unspun axes of its segment, and handed on there. The wrench
of each unit acceleration travels towards the base as far as the frame ``meeting``; there the screws of the joints
before it are known, and one product gives each entry.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from generator.symbolic.bodies import Body
from generator.symbolic.frames import Chain, Frame
from generator.symbolic.gauge import Gauge, Regauged, regauge
from generator.symbolic.kinematics import Screw
from generator.symbolic.lean_screws import Screws, screws
from generator.symbolic.lean_wrenches import descent, power
from generator.symbolic.matter import Matter, inertia, moved, spun_again, unspun
from generator.symbolic.matter import about_z as moment_about_z
from generator.symbolic.newton_euler import Wrench, along_axis
from generator.symbolic.segments import Spun, segments
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, array, cross, identity, zeros


@dataclass(frozen=True)
class InertiaStrategy:
    """How the matrix is written: the frame ``meeting`` where screws take over (0 for none), the choice of parameters.

    ``block_unspun`` reckons the entries of the joints before the meeting among themselves in unspun axes.
    """

    meeting: int = 0
    block_unspun: bool = False
    gauge: Gauge = field(default_factory=Gauge)

    def __str__(self) -> str:
        met = f", wrenches meet screws at frame {self.meeting}" if self.meeting else ""
        axes = ", the joints before it in axes that do not spin" if self.block_unspun else ""
        return f"composite bodies on segments{met}{axes}{self.gauge}"


def inertia_matrix(chain: Chain, bodies: Mapping[int, Body], strategy: InertiaStrategy) -> Array:
    """M(q) (n x n, symmetric) of the bodies, as ``inertia.inertia_matrix`` gives it."""
    meeting = strategy.meeting
    spun = segments(chain)
    chosen = regauge(chain, bodies, strategy.gauge)
    met = {frame.number for frame in chain.frames[meeting - 1].path()} if meeting else set()
    points = {} if strategy.block_unspun else _meeting_points(chain, chosen, meeting)
    own, in_unspun, about_z = _composites(chain, spun, chosen, met, points)
    own_screws, unspun_screws = screws(chain, spun, chosen.positions) if meeting else ({}, {})
    result = zeros(chain.program, chain.dof, chain.dof)
    for frame in chain.frames:
        if frame.number in met:
            if frame.number not in own:
                continue
            if strategy.block_unspun:
                turned = unspun(own[frame.number], spun[frame.number])
                _add_body(result, turned, unspun_screws[frame.number], moment_about_z(own[frame.number]))
            else:
                point = points.get(frame.number, zeros(chain.program, 3))
                moving = {c: at(s, point) for c, s in own_screws[frame.number].items()}
                _add_body(result, own[frame.number], moving, moment_about_z(own[frame.number]))
        elif frame.coordinate is not None and frame.number in in_unspun:
            wrench = _unit_acceleration(frame, in_unspun[frame.number], about_z[frame.number])
            _project(result, frame, spun, chosen, wrench, meeting, own_screws)
    return result


def _composites(
    chain: Chain, spun: Mapping[int, Spun], chosen: Regauged, met: set[int], points: Mapping[int, Array]
) -> tuple[dict[int, Matter], dict[int, Matter], dict[int, Node]]:
    """For each frame, all matter it carries: in own axes, in unspun axes, and its moment of inertia about z.

    Frames in ``met`` hand nothing on.
    """
    program = chain.program
    own: dict[int, Matter] = dict(chosen.parts)
    for j, point in points.items():
        own[j] = moved(own[j], identity(program, 3), -point)
    in_unspun: dict[int, Matter] = {}
    about_z: dict[int, Node] = {}
    for frame in reversed(chain.frames):
        j, link = frame.number, spun[frame.number]
        if j in met:
            continue
        if j in in_unspun:
            about_z[j] = moment_about_z(in_unspun[j])
        if j in own:
            about_z[j] = about_z.get(j, program.zero) + moment_about_z(own[j])
            _add(in_unspun, j, unspun(own[j], link))
        if j not in in_unspun or frame.parent is None:
            continue
        k, position = frame.parent.number, chosen.positions[j]
        if link.continues and k not in met:
            _add(in_unspun, k, moved(in_unspun[j], identity(program, 3), spun[k].to_unspun(position)))
        elif link.continues:
            arm = spun[k].to_unspun(position - points.get(k, zeros(program, 3)))
            _add(own, k, spun_again(moved(in_unspun[j], identity(program, 3), arm), spun[k]))
        else:
            _add(own, k, moved(in_unspun[j], link.entry, position - points.get(k, zeros(program, 3))))
    return own, in_unspun, about_z


def _add(matter: dict[int, Matter], j: int, more: Matter) -> None:
    matter[j] = matter[j] + more if j in matter else more


def _unit_acceleration(frame: Frame, composite: Matter, about_z: Node) -> Wrench:
    """The wrench, in unspun axes, that gives a composite body a unit acceleration of the joint that carries it.

    ``about_z`` is its moment of inertia about z, which turning the body about z leaves alone.
    """
    program = composite.mass.program
    mx, my, _ = composite.moment
    across = array(program, [-my, mx, 0])
    if frame.prismatic:
        return Wrench(array(program, [0, 0, composite.mass]), -across)
    s = composite.sigma
    return Wrench(across, array(program, [-s[0, 2], -s[1, 2], about_z]))


def _add_body(result: Array, part: Matter, carried_by: Mapping[int, Screw], about_z: Node) -> None:
    """What one body adds to the entries of all joints that carry it: s_i . (I s_k)."""
    tensor = inertia(part)
    tensor[2, 2] = about_z
    for k, screw in carried_by.items():
        before = {i: other for i, other in carried_by.items() if i < k}
        f = part.mass * screw.v + cross(screw.w, part.moment)
        n = tensor @ screw.w + cross(part.moment, screw.v)
        for i, other in before.items():
            _put(result, i, k, result[i, k] + power(other, Wrench(f, n)))
        own = power(screw, Wrench(f, n)) if before else _twice_energy(part, screw, about_z)
        _put(result, k, k, result[k, k] + own)


def _twice_energy(part: Matter, screw: Screw, about_z: Node) -> Node:
    """s . (I s) of one screw: w.Jw + 2 v.(w x MS) + M v.v, with w.w = 1 taken out of the first term."""
    w, s = screw.w, part.sigma
    program = part.mass.program
    turning = [i for i in range(3) if w[i] is not program.zero]
    total: Node = part.mass * (screw.v @ screw.v) + 2 * (screw.v @ cross(w, part.moment))
    if turning:
        last = turning[-1]
        about_last = s[(last + 1) % 3, (last + 1) % 3] + s[(last + 2) % 3, (last + 2) % 3]
        total = total + (about_z if last == 2 else about_last)
        for place, i in enumerate(turning[:-1]):
            row = w[i] * (s[last, last] - s[i, i])
            for k in turning[place + 1 :]:
                row = row - w[k] * (2 * s[i, k])
            total = total + w[i] * row
    return total


def _project(
    result: Array,
    frame: Frame,
    spun: Mapping[int, Spun],
    chosen: Regauged,
    wrench: Wrench,
    meeting: int,
    met_screws: Screws,
) -> None:
    """Fills the entries of a joint with itself and with every joint that carries it."""
    column = frame.coordinate
    assert column is not None
    for carrier, carried in descent(frame, spun, chosen.positions, wrench):
        row = carrier.coordinate
        if row is not None:
            _put(result, row, column, along_axis(carrier, carried))
        link = spun[carrier.number]
        if carrier.parent is not None and carrier.parent.number == meeting and not link.continues:
            met = Wrench(link.entry @ carried.f, link.entry @ carried.n)
            for i, screw in met_screws[meeting].items():
                _put(result, i, column, power(at(screw, chosen.positions[carrier.number]), met))
            return


def _meeting_points(chain: Chain, chosen: Regauged, meeting: int) -> dict[int, Array]:
    """Where the meeting frame's own body is reckoned: at the origin of the one frame that it carries, if it is one."""
    carried = [frame for frame in chain.frames if frame.parent is not None and frame.parent.number == meeting]
    return {meeting: chosen.positions[carried[0].number]} if len(carried) == 1 else {}


def at(screw: Screw, point: Array) -> Screw:
    """The same motion at another point of the frame."""
    return Screw(screw.w, screw.v + cross(screw.w, point))


def _put(result: Array, i: int, k: int, entry: Node) -> None:
    result[i, k] = result[k, i] = entry
