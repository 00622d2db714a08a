"""What is written into the picture: the frames' axes, the table's lengths, the joints' positive senses."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from generator.review.formula import Name, formula
from generator.review.markup import Markup, join
from generator.review.picture import solids
from generator.review.picture.annotate import Sheet
from generator.review.picture.body import Seat
from generator.review.picture.skeleton import Array, Placement, Skeleton
from generator.review.picture.view import Point, View
from generator.review.plain import plain
from generator.robot.description import PRISMATIC

_LONG, _SHORT = 40.0, 30.0
#: An axis whose picture is shorter than this is drawn as pointing at the viewer or away.
_END_ON = 0.15
#: A stretch shorter than this [px] is not seen.
_SEEN = 1.5


@dataclass
class _Axis:
    """Axes of one letter that start at one point and point in one direction, drawn as one arrow."""

    letter: str
    start: Point
    across: Point
    towards: float
    names: list[Name]


def axes(placement: Placement, view: View, sheet: Sheet, *, named: bool = True) -> Markup:
    """x and z of every frame as arrows, ``named`` by letter and number."""
    arrows: dict[tuple[object, ...], _Axis] = {}
    for number, frame in enumerate(placement.frames):
        for letter, column in (("x", 0), ("z", 2)):
            start, across = view(frame[:3, 3]), view.direction(frame[:3, column])
            towards = float(view.rows[2] @ frame[:3, column])
            key = (letter, towards > 0, *(round(value, 2) + 0.0 for value in (*start, *across)))
            axis = arrows.setdefault(key, _Axis(letter, start, across, towards, []))
            axis.names.append(Name(f"{letter}{number}"))
    reach = _LONG if named else _SHORT
    drawn, labels = [], []
    for axis in arrows.values():
        kind = f"axis-{axis.letter}"
        end = (axis.start[0] + reach * axis.across[0], axis.start[1] + reach * axis.across[1])
        if math.hypot(*axis.across) < _END_ON:
            end = axis.start
            drawn.append(solids.towards_viewer(end, kind, away=axis.towards < 0))
        else:
            drawn.append(solids.arrow(axis.start, end, kind))
            sheet.occupy([axis.start, end])
        labels.append((axis.names, end, kind, axis.across))
    if not named:
        return join(drawn)
    return join(drawn, [sheet.label(names, at, kind, prefer=lean) for names, at, kind, lean in labels])


def dimensions(arm: Skeleton, placement: Placement, view: View, sheet: Sheet, unseen_in: View | None = None) -> Markup:
    """Each b, d and r of the table, as it stands there, beside the stretch that it measures.

    With ``unseen_in`` only lengths that the other view hides, joint variables left out.
    """
    labels = []
    for link, corners in zip(arm.links, placement.corners, strict=True):
        joint = link.joint
        for expression, start, end in zip((joint.b, joint.d, joint.r), corners[:-1], corners[1:], strict=True):
            if expression == 0 or not visible(view, start, end):
                continue
            if unseen_in is not None and (visible(unseen_in, start, end) or joint.variable in expression.free_symbols):
                continue
            labels.append(sheet.label([Name(plain(formula(expression)))], view((start + end) / 2), "dimension"))
    return join(labels)


def visible(view: View, start: Array, end: Array) -> bool:
    """Whether a stretch is long enough to be seen in a view."""
    first, last = view(start), view(end)
    return math.hypot(last[0] - first[0], last[1] - first[1]) > _SEEN


def senses(seated: list[Seat], placement: Placement, view: View, sheet: Sheet) -> Markup:
    """The joint variables, each with an arrow in its positive sense."""
    drawn = []
    for seat in seated:
        joint, centre = seat.link.joint, view(seat.centre)
        frame = placement.frames[joint.number, :3, :3]
        if joint.sigma == PRISMATIC:
            across = view.direction(frame[:, 2])
            side = np.array([-across[1], across[0]]) * 1.6 * seat.radius
            half = 1.1 * seat.radius * np.array(across)
            start, end = np.array(centre) + side - half, np.array(centre) + side + half
            track = [(float(start[0]), float(start[1])), (float(end[0]), float(end[1]))]
            drawn.append(solids.arrow(track[0], track[1], "sense"))
        else:
            track = solids.circle(view, seat.centre, frame, 1.5 * seat.radius)
            drawn.append(solids.bent_arrow(track, "sense"))
        sheet.occupy(track, 2.0)
    labels = [
        sheet.label([Name(seat.link.joint.variable.name)], view(seat.centre), "joint", clear=1.2 * seat.radius)
        for seat in seated
    ]
    return join(drawn, labels)
