"""Screws of the joints on segments of parallel axes: what a joint's unit speed does to each frame that it carries."""

from __future__ import annotations

from collections.abc import Mapping

from generator.symbolic.frames import Chain
from generator.symbolic.kinematics import Screw
from generator.symbolic.segments import Spun, segments
from generator.symbolic.vectors import Array, array, cross, zeros

#: Screws by frame number and coordinate.
Screws = Mapping[int, Mapping[int, Screw]]


def own_screws(chain: Chain, positions: Mapping[int, Array]) -> Screws:
    """For each frame, by coordinate, the screws of the joints that carry it, in own axes at ``positions``."""
    return screws(chain, segments(chain), positions)[0]


def screws(chain: Chain, spun: Mapping[int, Spun], positions: Mapping[int, Array]) -> tuple[Screws, Screws]:
    """The screws in own and in unspun axes, for origins at ``positions`` in their antecedents."""
    program = chain.program
    z, nothing = array(program, [0, 0, 1]), zeros(program, 3)
    in_unspun: dict[int, dict[int, Screw]] = {}
    own: dict[int, dict[int, Screw]] = {}
    for frame in chain.frames:
        j, link = frame.number, spun[frame.number]
        mine: dict[int, Screw] = {}
        if frame.parent is not None:
            k = frame.parent.number
            arm = spun[k].to_unspun(positions[j]) if link.continues else positions[j]
            for coordinate, screw in (in_unspun if link.continues else own)[k].items():
                v = screw.v + cross(screw.w, arm)
                mine[coordinate] = Screw(link.entry.T @ screw.w, link.entry.T @ v)
        if frame.coordinate is not None:
            mine[frame.coordinate] = Screw(z, nothing) if frame.revolute else Screw(nothing, z)
        in_unspun[j] = mine
        own[j] = {c: Screw(link.to_own(screw.w), link.to_own(screw.v)) for c, screw in mine.items()}
    return own, in_unspun
