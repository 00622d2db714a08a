"""Wrenches on segments of parallel axes: from frame to frame towards the base, and what they do along screws."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from generator.symbolic.frames import Frame
from generator.symbolic.kinematics import Screw
from generator.symbolic.newton_euler import Wrench
from generator.symbolic.segments import Spun
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, cross


def in_unspun_axes(link: Spun, wrench: Wrench) -> Wrench:
    """A wrench from own to unspun axes."""
    return Wrench(link.to_unspun(wrench.f), link.to_unspun(wrench.n))


def handed_on(link: Spun, below: Spun, position: Array, wrench: Wrench) -> Wrench:
    """A wrench in the unspun axes of a frame as its antecedent gets it, about the antecedent's origin: in unspun axes
    where the segment continues, else in own ones. ``position`` is the frame's origin in the antecedent's own axes.
    """
    if link.continues:
        return Wrench(wrench.f, wrench.n + cross(below.to_unspun(position), wrench.f))
    f = link.entry @ wrench.f
    return Wrench(f, link.entry @ wrench.n + cross(position, f))


def descent(
    frame: Frame, spun: Mapping[int, Spun], positions: Mapping[int, Array], wrench: Wrench
) -> Iterator[tuple[Frame, Wrench]]:
    """The frames from one to the base, each with a ``wrench`` on the first in its unspun axes about its origin.

    ``positions`` are the frames' origins in their antecedents.
    """
    yield frame, wrench
    while frame.parent is not None:
        link, below = spun[frame.number], spun[frame.parent.number]
        wrench = handed_on(link, below, positions[frame.number], wrench)
        frame, wrench = frame.parent, wrench if link.continues else in_unspun_axes(below, wrench)
        yield frame, wrench


def power(screw: Screw, wrench: Wrench) -> Node:
    """Power of a wrench along a screw, both in the same axes at the same point."""
    total: Node = screw.w @ wrench.n + screw.v @ wrench.f
    return total
