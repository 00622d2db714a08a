"""Regressor columns of the inertial parameters: the joints' torques for the wrench of one unit parameter."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic import lean_motion, newton_euler
from generator.symbolic.frames import Chain, Frame
from generator.symbolic.gauge import Origins, slid, slid_origins
from generator.symbolic.kinematics import Screw
from generator.symbolic.lean_screws import Beside, screws_beside
from generator.symbolic.lean_wrenches import descent, handed_on, in_unspun_axes, power
from generator.symbolic.newton_euler import Motion, Wrench, along_axis
from generator.symbolic.segments import Spun, segments
from generator.symbolic.statements import Node, Program
from generator.symbolic.vectors import Array, Nodes, array, cross, dot, zeros
from generator.words import numbered

#: Entries of the inertia tensor that each of its parameters fills.
_TENSOR = {"XX": (0, 0), "XY": (0, 1), "XZ": (0, 2), "YY": (1, 1), "YZ": (1, 2), "ZZ": (2, 2)}


def _unit_wrench(program: Program, parameter: str, motion: Motion) -> Wrench:
    """Force and moment per unit of one inertial parameter: the columns of F and N."""
    nothing = zeros(program, 3)
    if parameter == "M":
        return Wrench(motion.a, nothing)
    if parameter in ("MX", "MY", "MZ"):
        k = ("MX", "MY", "MZ").index(parameter)
        unit = array(program, [int(i == k) for i in range(3)])
        return Wrench(motion.u[:, k], cross(unit, motion.a))
    row, column = _TENSOR[parameter]
    return Wrench(nothing, _tensor_moment(program, row, column, motion))


def _tensor_moment(program: Program, a: int, b: int, motion: Motion) -> Array:
    """J wd + w x J w for a tensor J whose only entries are J_ab = J_ba = 1.

    With c the third index and s the sign of the permutation (a, b, c), the moment is
    n_a = -s U_ca, n_b = s U_cb, n_c = s (U_aa - U_bb): the products of w that U holds serve every column, and the
    differences too.
    """
    w, wd, u = motion.w, motion.wd, motion.u
    moment = zeros(program, 3)
    if a == b:
        b, c = (a + 1) % 3, (a + 2) % 3
        moment[a], moment[b], moment[c] = wd[a], w[a] * w[c], -(w[a] * w[b])
        return moment
    c = 3 - a - b
    s = 1 if (a + 1) % 3 == b else -1
    moment[a], moment[b], moment[c] = -s * u[c, a], s * u[c, b], -motion.differences[c]
    return moment


@dataclass(frozen=True)
class RegressorStrategy:
    """How columns are written: about frames ``slide`` moved along their axes, parallel screws by their difference;
    wrenches of bodies behind the frames ``meetings``, each the last of its segment, meet the screws there, others in
    their own frames.
    """

    slide: frozenset[int] = frozenset()
    meetings: frozenset[int] = frozenset()

    def __str__(self) -> str:
        there = "that frame" if len(self.meetings) == 1 else "those frames"
        met = f", behind {numbered('frame', self.meetings)} at {there}" if self.meetings else ""
        return f"wrenches on screws, parallel ones by their difference{met}{slid(self.slide)}"


#: A column of a frame's origin in terms of columns of a point r before it on the axis: factor, power of r, parameter.
_SHIFTED = {
    "MX": ((-1, 1, "XZ"),),
    "MY": ((-1, 1, "YZ"),),
    "MZ": ((2, 1, "XX"), (2, 1, "YY")),
    "M": ((1, 1, "MZ"), (1, 2, "XX"), (1, 2, "YY")),
}


@dataclass(frozen=True)
class _Projection:
    """Columns of the bodies' parameters by wrenches on screws, for motions about the ``origins`` put elsewhere."""

    chain: Chain
    origins: Origins
    meetings: Collection[int]
    motion: Mapping[int, Motion]

    @cached_property
    def _spun(self) -> dict[int, Spun]:
        return segments(self.chain)

    @cached_property
    def _screws(self) -> Mapping[int, Mapping[int, Screw | Beside]]:
        return screws_beside(self.chain, self.origins.positions)

    def columns(self, frame: Frame, stems: Iterable[str]) -> dict[str, dict[int, Node]]:
        """The columns of a body's parameters ``stems``, from motion and screws of a point of its axis.

        The frame's origin stands r along z from that point; what moves little there is cheaper there, and a column
        moves back by one product per entry.
        """
        r, program = self.origins.offsets[frame.number], self.chain.program
        result: dict[str, dict[int, Node]] = {}
        for stem in stems:
            entries = self._column(frame, stem)
            for factor, exponent, other in _SHIFTED.get(stem, ()) if r is not program.zero else ():
                scale = factor * (r if exponent == 1 else r * r)
                for coordinate, entry in self._column(frame, other).items():
                    entries[coordinate] = entries[coordinate] + scale * entry
            result[stem] = entries
        return result

    def _column(self, frame: Frame, parameter: str) -> dict[int, Node]:
        """Torque per unit of ``parameter`` of the body of ``frame``, by coordinate of the joints that carry it."""
        wrench = _unit_wrench(self.chain.program, parameter, self.motion[frame.number])
        meeting = next((one for one in frame.path() if one.number in self.meetings), frame)
        screws, positions = self._screws[meeting.number], self.origins.positions
        if meeting is frame:
            return _on_screws(wrench, screws)
        entries: dict[int, Node] = {}
        wrench = in_unspun_axes(self._spun[frame.number], wrench)
        for one, carried in descent(frame, self._spun, positions, wrench):
            if one.coordinate is not None:
                entries[one.coordinate] = along_axis(one, carried)
            if one.parent is meeting:
                wrench = handed_on(self._spun[one.number], self._spun[meeting.number], positions[one.number], carried)
                break
        return dict(sorted({**entries, **_on_screws(wrench, screws)}.items()))


def _on_screws(wrench: Wrench, carried_by: Mapping[int, Screw | Beside]) -> dict[int, Node]:
    """Torque of a wrench, by coordinate of the joints with these screws."""
    entries = {c: power(screw, wrench) for c, screw in carried_by.items() if isinstance(screw, Screw)}
    for c, screw in carried_by.items():
        if isinstance(screw, Beside):
            entries[c] = entries[screw.coordinate] + dot(screw.v, wrench.f)
    return {c: entries[c] for c in carried_by}


def columns(
    chain: Chain,
    names: Collection[str],
    qd: Nodes,
    qdd: Nodes,
    way: RegressorStrategy | None,
    readable: bool = True,
) -> dict[str, dict[int, Node]]:
    """Columns of the inertial parameters ``names``, each {coordinate: entry}, written in the given way; None is the
    textbook recursion, whose wrenches have names if ``readable``.
    """
    if way is None:
        return _recursive_columns(chain, names, newton_euler.motions(chain, qd, qdd), readable)
    origins = slid_origins(chain, way.slide)
    projection = _Projection(chain, origins, way.meetings, lean_motion.own_motions(chain, origins, qd, qdd))
    result: dict[str, dict[int, Node]] = {}
    for frame in chain.frames:
        j = frame.number
        found = projection.columns(frame, _stems(j, names))
        result |= {f"{stem}{j}": entries for stem, entries in found.items()}
    return result


def _recursive_columns(
    chain: Chain, names: Collection[str], motion: Mapping[int, Motion], readable: bool
) -> dict[str, dict[int, Node]]:
    """Each unit wrench through the backward recursion (W. Khalil, E. Dombre, Modeling, Identification and Control of
    Robots, 2002, ch. 12).
    """
    result: dict[str, dict[int, Node]] = {}
    for frame in chain.frames:
        j = frame.number
        coordinates = sorted(one.coordinate for one in frame.path() if one.coordinate is not None)
        for stem in _stems(j, names):
            unit = {j: _unit_wrench(chain.program, stem, motion[j])}
            torques = newton_euler.joint_torques(chain, unit, f"{stem}{j}" if readable else None)
            result[f"{stem}{j}"] = {coordinate: torques[coordinate] for coordinate in coordinates}
    return result


def _stems(j: int, names: Collection[str]) -> list[str]:
    """Of the parameters of body j among ``names``."""
    return [stem for stem in INERTIAL_STEMS if f"{stem}{j}" in names]
