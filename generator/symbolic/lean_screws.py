"""Screws of the joints on segments of parallel axes: what a joint's unit speed does to each frame that it carries."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from generator.symbolic.frames import Chain, Frame
from generator.symbolic.kinematics import Screw
from generator.symbolic.segments import Spun, segments
from generator.symbolic.statements import Program
from generator.symbolic.vectors import Array, array, cross, zeros

#: Screws by frame number and coordinate.
Screws = Mapping[int, Mapping[int, Screw]]


@dataclass(frozen=True)
class Beside:
    """A screw that turns as that of another ``coordinate``, about a parallel axis: its v is that one's and ``v``."""

    coordinate: int
    v: Array


def screws_beside(chain: Chain, positions: Mapping[int, Array]) -> Mapping[int, Mapping[int, Screw | Beside]]:
    """For each frame, by coordinate, the screws of the joints that carry it, in own axes at ``positions``.

    Of joints with parallel axes in a row, the last has its screw and the others stand beside it.
    """
    spun = segments(chain)
    in_unspun: dict[int, dict[int, Screw | Beside]] = {}
    own: dict[int, dict[int, Screw | Beside]] = {}
    for frame in chain.frames:
        j, link = frame.number, spun[frame.number]
        mine: dict[int, Screw | Beside] = {}
        if frame.parent is not None:
            k, last = frame.parent.number, frame.parent.coordinate
            arm = _arm(spun[k], positions[j], link)
            for coordinate, screw in (in_unspun if link.continues else own)[k].items():
                if isinstance(screw, Screw):
                    mine[coordinate] = _carried(screw, arm, link)
                else:
                    mine[coordinate] = Beside(screw.coordinate, link.entry.T @ screw.v)
            if link.continues and last is not None and frame.coordinate is not None:
                mine = _based_on(frame.coordinate, last, mine)
        if frame.coordinate is not None:
            mine[frame.coordinate] = _own(frame, chain.program)
        in_unspun[j] = mine
        own[j] = {c: _turned(screw, link) for c, screw in mine.items()}
    return own


def _own(frame: Frame, program: Program) -> Screw:
    """The screw of a frame's own joint, in its axes."""
    z, nothing = array(program, [0, 0, 1]), zeros(program, 3)
    return Screw(z, nothing) if frame.revolute else Screw(nothing, z)


def _arm(antecedent: Spun, position: Array, link: Spun) -> Array:
    """A frame's origin in the axes of its antecedent from which ``link`` leads on: the unspun ones in a row."""
    return antecedent.to_unspun(position) if link.continues else position


def _carried(screw: Screw, arm: Array, link: Spun) -> Screw:
    """A screw of the antecedent at the origin of the next frame, in that one's unspun axes."""
    return Screw(link.entry.T @ screw.w, link.entry.T @ (screw.v + cross(screw.w, arm)))


def _based_on(coordinate: int, last: int, mine: Mapping[int, Screw | Beside]) -> dict[int, Screw | Beside]:
    """The screw of the joint ``last``, and those beside it, beside that of the joint that starts at this origin."""
    result = dict(mine)
    for c, screw in mine.items():
        if c == last:
            result[c] = Beside(coordinate, screw.v)
        elif isinstance(screw, Beside) and screw.coordinate == last:
            result[c] = Beside(coordinate, screw.v + mine[last].v)
    return result


def _turned(screw: Screw | Beside, link: Spun) -> Screw | Beside:
    if isinstance(screw, Screw):
        return Screw(link.to_own(screw.w), link.to_own(screw.v))
    return Beside(screw.coordinate, link.to_own(screw.v))


def screws(chain: Chain, spun: Mapping[int, Spun], positions: Mapping[int, Array]) -> tuple[Screws, Screws]:
    """The screws in own and in unspun axes, for origins at ``positions`` in their antecedents."""
    in_unspun: dict[int, dict[int, Screw]] = {}
    own: dict[int, dict[int, Screw]] = {}
    for frame in chain.frames:
        j, link = frame.number, spun[frame.number]
        mine: dict[int, Screw] = {}
        if frame.parent is not None:
            k = frame.parent.number
            arm = _arm(spun[k], positions[j], link)
            for coordinate, screw in (in_unspun if link.continues else own)[k].items():
                mine[coordinate] = _carried(screw, arm, link)
        if frame.coordinate is not None:
            mine[frame.coordinate] = _own(frame, chain.program)
        in_unspun[j] = mine
        own[j] = {c: Screw(link.to_own(screw.w), link.to_own(screw.v)) for c, screw in mine.items()}
    return own, in_unspun
