"""The picture of the arm: a flat view with dimensions and frames, and a raised one with the joints' positive senses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from generator.review.markup import Markup, join
from generator.review.picture.annotate import Sheet
from generator.review.picture.annotations import axes, dimensions, senses
from generator.review.picture.body import Seat, floor, floor_corners, seats, symbols, tool_fork, tubes
from generator.review.picture.pose import legible
from generator.review.picture.skeleton import Placement, Skeleton, place, skeleton
from generator.review.picture.view import View, flat_view, raised_view
from generator.review.svg import svg
from generator.robot.description import Robot

_WIDTH, _MARGIN = 560.0, 70.0
_LOWEST, _HIGHEST = 340.0, 540.0


@dataclass(frozen=True)
class Drawing:
    """Pictures by the name of their view, and the joint positions (n,) [rad, m] that they show."""

    views: tuple[tuple[str, Markup], ...]
    q: tuple[float, ...]


def draw(robot: Robot) -> Drawing:
    """A flat and a raised view of a robot, at a configuration that shows it well."""
    arm = skeleton(robot)
    q = legible(arm)
    placement = place(arm, q)
    corners = np.concatenate([placement.corners.reshape(-1, 3), placement.frames[:, :3, 3]])
    with_floor = np.concatenate([corners, floor_corners(arm)])
    flat, raised = flat_view(arm, placement), raised_view(arm, placement)
    height = max(flat.height(corners, _WIDTH, _MARGIN), raised.height(with_floor, _WIDTH, _MARGIN))
    height = float(round(min(max(height, _LOWEST), _HIGHEST)))
    flat = flat.fitted(corners, _WIDTH, height, _MARGIN)
    raised = raised.fitted(with_floor, _WIDTH, height, _MARGIN)
    pictures = (
        (flat.name, _flat_picture(arm, placement, flat, height)),
        (raised.name, _raised_picture(arm, placement, raised, height, flat)),
    )
    return Drawing(pictures, tuple(float(value) for value in q))


def _flat_picture(arm: Skeleton, placement: Placement, view: View, height: float) -> Markup:
    sheet, _, body = _body(arm, placement, view, height)
    body += [axes(placement, view, sheet), dimensions(arm, placement, view, sheet)]
    return _framed(arm, view, height, body, "its frames and dimensions")


def _raised_picture(arm: Skeleton, placement: Placement, view: View, height: float, flat: View) -> Markup:
    sheet, seated, body = _body(arm, placement, view, height)
    body += [axes(placement, view, sheet, named=False), senses(seated, placement, view, sheet)]
    body.append(dimensions(arm, placement, view, sheet, unseen_in=flat))
    return _framed(arm, view, height, body, "its joints and their positive senses")


def _body(arm: Skeleton, placement: Placement, view: View, height: float) -> tuple[Sheet, list[Seat], list[Markup]]:
    sheet = Sheet(_WIDTH, height)
    seated = seats(arm, placement, view)
    drawn = [floor(arm, view, sheet), tubes(arm, placement, view, sheet), tool_fork(arm, placement, view, sheet)]
    return sheet, seated, [*drawn, symbols(seated, placement, view, sheet)]


def _framed(arm: Skeleton, view: View, height: float, body: list[Markup], what: str) -> Markup:
    title = f"{view.name} of {arm.robot.name}"
    return svg(_WIDTH, height, title, f"{title} with {what}.", join(*body, by="\n"), kind="arm")
