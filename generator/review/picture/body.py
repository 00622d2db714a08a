"""The arm's body: its mounting, its links as tubes, its joints as cylinders and boxes, the fork at its tool frame."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from generator.review.markup import Markup, join
from generator.review.picture import solids
from generator.review.picture.annotate import Sheet
from generator.review.picture.skeleton import Array, Link, Placement, Skeleton
from generator.review.picture.view import Point, View
from generator.robot.description import FIXED, PRISMATIC

_TUBE = 15.0
#: Half the side of the floor, in mean lengths of the links.
_FLOOR = 0.75
_PLATE = 27.0


@dataclass(frozen=True)
class Seat:
    """Where the symbol of a joint sits on its axis [m], and its radius [px]."""

    link: Link
    centre: Array
    radius: float


def seats(arm: Skeleton, placement: Placement, view: View) -> list[Seat]:
    """Seats of the moving joints: amid r where there is one, else at the frame, clear of each other."""
    taken: list[Array] = []
    result = []
    for link in arm.links:
        if link.joint.sigma == FIXED:
            continue
        number = link.joint.number
        radius = 17.0 - 6.0 * (number - 1) / max(len(arm.links) - 1, 1)
        reach = 2.0 * radius / view.scale
        *_, before, end = placement.corners[number - 1]
        axis = placement.frames[number, :3, 2]
        centre = end
        if np.linalg.norm(end - before) > 1.6 * reach:
            centre = before + (0.25 if link.joint.sigma == PRISMATIC else 0.5) * (end - before)
        if np.linalg.norm(centre - arm.base[:3, 3]) < 0.5 * reach and not taken:
            centre = centre + 0.6 * reach * axis * (1 if axis @ arm.base[:3, 2] >= 0 else -1)
        while any(np.linalg.norm(centre - other) < 0.7 * reach for other in taken):
            centre = centre + 1.3 * reach * axis
        taken.append(centre)
        result.append(Seat(link, centre, radius))
    return result


def symbols(seated: list[Seat], placement: Placement, view: View, sheet: Sheet) -> Markup:
    """The joints, the farthest first: revolute ones as cylinders about their axes, prismatic ones as boxes."""
    drawn = []
    for seat in sorted(seated, key=lambda seat: round(view.depth(seat.centre), 6)):
        joint, radius = seat.link.joint, seat.radius
        frame = placement.frames[joint.number, :3, :3]
        title = f"joint {joint.number}, {'prismatic' if joint.sigma == PRISMATIC else 'revolute'}"
        centre = view(seat.centre)
        if joint.sigma == PRISMATIC:
            halves = (0.8 * radius, 0.8 * radius, 1.3 * radius)
            drawn.append(solids.box(view, seat.centre, frame, halves, title, "slide"))
        else:
            drawn.append(solids.cylinder(view, centre, frame[:, 2], radius, 1.15 * radius, title, "hinge"))
        across = view.direction(frame[:, 2])
        ends = [(centre[0] + s * 1.3 * radius * across[0], centre[1] + s * 1.3 * radius * across[1]) for s in (-1, 1)]
        sheet.occupy(ends, radius)
        sheet.occupy_disc(centre, 1.1 * radius)
    return join(drawn)


def tubes(arm: Skeleton, placement: Placement, view: View, sheet: Sheet) -> Markup:
    """Links as tubes; what hangs on one chain shares an outline, other branches cross over or under it."""
    branches: dict[int, list[list[Point]]] = {}
    branch_of = {0: 0}
    for link in arm.links:
        number, antecedent = link.joint.number, link.joint.antecedent
        first = not any(other.joint.antecedent == antecedent for other in arm.links[: number - 1])
        branch_of[number] = branch_of[antecedent] if first else number
        path = [view(corner) for corner in placement.corners[number - 1]]
        branches.setdefault(branch_of[number], []).append(path)
        sheet.occupy(path, _TUBE / 2)
    depth = {branch: round(view.depth(placement.frames[max(branch, 1), :3, 3]), 6) for branch in branches}
    return join([solids.tube(branches[branch], _TUBE) for branch in sorted(branches, key=lambda b: depth[b])])


def floor(arm: Skeleton, view: View, sheet: Sheet) -> Markup:
    """The mounting plane of frame 0 as a grid, with a plate on it."""
    origin, axes = arm.base[:3, 3], arm.base[:3, :3]
    lines = []
    if abs(float(view.rows[2] @ axes[:, 2])) < 0.9:
        reach = _FLOOR * arm.size
        for k in range(-3, 4):
            for along, across in ((0, 1), (1, 0)):
                middle = origin + axes[:, across] * (k * reach / 3)
                ends = middle - axes[:, along] * reach, middle + axes[:, along] * reach
                lines.append(solids.line(view(ends[0]), view(ends[1]), "floor"))
    sheet.occupy_disc(view(origin), _PLATE * max(0.6, abs(float(view.rows[2] @ axes[:, 2]))))
    return join(lines, solids.cylinder(view, view(origin), axes[:, 2], _PLATE, 4.0, "base", "base"))


def floor_corners(arm: Skeleton) -> Array:
    """Corners (4, 3) of the grid [m]."""
    signs = np.array([(-1, -1), (-1, 1), (1, -1), (1, 1)], dtype=float)
    corners: Array = arm.base[:3, 3] + _FLOOR * arm.size * signs @ arm.base[:3, :2].T
    return corners


def tool_fork(arm: Skeleton, placement: Placement, view: View, sheet: Sheet) -> Markup:
    """A fork at the tool frame, open in the direction in which the arm ends; nothing where no tool frame is given."""
    tool = arm.robot.tool
    if not tool.tool:
        return join()
    origin = placement.frames[tool.number, :3, 3]
    axes = placement.frames[tool.number, :3, :3]
    arriving = _last_step(arm, placement, tool.number)
    ahead = max((s * axes[:, k] for k in (2, 0, 1) for s in (1, -1)), key=lambda a: round(float(a @ arriving), 6))
    sides = [axes[:, k] for k in range(3) if abs(float(axes[:, k] @ ahead)) < 0.5]
    side = max(sides, key=lambda a: round(math.hypot(*view.direction(a)), 6))
    unit = 11.0 / view.scale
    fingers = []
    for sign in (1, -1):
        knuckle = origin + sign * unit * side
        fingers.append([view(origin), view(knuckle), view(knuckle + 1.6 * unit * ahead)])
        sheet.occupy(fingers[-1], 4.0)
    return solids.tube(fingers, 7.0)


def _last_step(arm: Skeleton, placement: Placement, number: int) -> Array:
    """The last stretch that is not nothing on the way from the base to a frame; z of the frame if there is none."""
    at = number
    while at:
        for start, end in ((2, 3), (1, 2), (0, 1)):
            step: Array = placement.corners[at - 1, end] - placement.corners[at - 1, start]
            if np.linalg.norm(step) > 1e-6:
                return step
        at = arm.links[at - 1].joint.antecedent
    direction: Array = placement.frames[number, :3, 2]
    return direction
