"""Orthographic views: a direction to look from, and the fit of the picture to its sheet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from generator.review.picture.skeleton import Array, Placement, Skeleton
from generator.robot.description import REVOLUTE

Point = tuple[float, float]

#: The perspective view: turned from the side view about the vertical, and raised.
_AZIMUTH, _ELEVATION = np.radians(38.0), np.radians(20.0)


@dataclass(frozen=True)
class View:
    """``rows``: unit vectors to the right, upward and towards the viewer, in the world frame; ``scale`` [px/m]."""

    name: str
    rows: Array
    scale: float = 1.0
    shift: Point = (0.0, 0.0)

    def __call__(self, point: Array) -> Point:
        """Where a point [m] falls on the sheet [px], y downward."""
        right, up, _ = self.rows @ point
        return (self.shift[0] + self.scale * float(right), self.shift[1] - self.scale * float(up))

    def direction(self, vector: Array) -> Point:
        """The picture of a free vector of unit length, between 0 and 1."""
        right, up, _ = self.rows @ vector
        return (float(right), -float(up))

    def depth(self, point: Array) -> float:
        """Greater is nearer to the viewer [m]."""
        return float(self.rows[2] @ point)

    def fitted(self, points: Array, width: float, height: float, margin: float) -> View:
        """The same view, scaled and shifted so that ``points`` (k, 3) fill the sheet up to the margin."""
        low, wide, high = self._extent(points)
        scale = min((width - 2 * margin) / wide, (height - 2 * margin) / high)
        middle = low + np.array([wide, high]) / 2
        shift = (width / 2 - scale * float(middle[0]), height / 2 + scale * float(middle[1]))
        return View(self.name, self.rows, scale, shift)

    def height(self, points: Array, width: float, margin: float) -> float:
        """The height of a sheet that ``points`` fill when they fill its width."""
        _, wide, high = self._extent(points)
        return (width - 2 * margin) * high / wide + 2 * margin

    def _extent(self, points: Array) -> tuple[Array, float, float]:
        flat = points @ self.rows[:2].T
        low, high = flat.min(axis=0), flat.max(axis=0)
        wide, tall = np.maximum(high - low, 1e-9)
        return low, float(wide), float(tall)


def flat_view(arm: Skeleton, placement: Placement) -> View:
    """The view that shows most: along the axes that joints share, shortening little."""
    normal = max(_normals(arm, placement), key=lambda axis: round(_shown(axis, arm, placement), 6))
    upright = abs(float(normal @ arm.up)) > 0.9
    if upright:
        normal = arm.up
        spread = placement.frames[-1, :3, 3] - arm.base[:3, 3]
        upward = np.cross(normal, spread - (spread @ normal) * normal)
    else:
        upward = arm.up - (arm.up @ normal) * normal
    rows = _basis(normal, upward)
    tips = placement.frames[1:, :3, 3].mean(axis=0) - arm.base[:3, 3]
    if not upright and rows[0] @ tips < -1e-6:
        rows = _basis(-normal, upward)
    return View("Top view" if upright else "Side view", rows)


def raised_view(arm: Skeleton, placement: Placement) -> View:
    """A view from above and from the side of the flat one, or, where that is from above, from where most is seen."""
    flat = flat_view(arm, placement).rows
    if abs(float(flat[2] @ arm.up)) < 0.9:
        return View("Perspective view", _raised(flat[0], _AZIMUTH, arm.up))
    level = arm.base[:3, int(np.argmin(np.abs(arm.base[:3, :3].T @ arm.up)))]
    around = [_raised(level, angle, arm.up) for angle in np.arange(12) * np.pi / 6 + _AZIMUTH]
    return View("Perspective view", max(around, key=lambda rows: round(_unshortened(rows[2], placement), 6)))


def _raised(right: Array, azimuth: float, up: Array) -> Array:
    """Rows of a view turned by ``azimuth`` about the vertical from the one with ``right`` to the right."""
    right = right - (right @ up) * up
    right = right / np.linalg.norm(right)
    ahead = np.cos(azimuth) * np.cross(right, up) + np.sin(azimuth) * right
    return _basis(np.cos(_ELEVATION) * ahead + np.sin(_ELEVATION) * up, up)


def _basis(normal: Array, upward: Array) -> Array:
    """Right, up and towards the viewer, right-handed."""
    normal = normal / np.linalg.norm(normal)
    upward = upward - (upward @ normal) * normal
    if np.linalg.norm(upward) < 1e-9:
        upward = np.eye(3)[int(np.argmin(np.abs(normal)))]
        upward = upward - (upward @ normal) * normal
    upward = upward / np.linalg.norm(upward)
    return np.stack([np.cross(upward, normal), upward, normal])


def _normals(arm: Skeleton, placement: Placement) -> list[Array]:
    """Directions worth looking along: the joint axes that are level or upright, and the level ones of frame 0."""
    axes = [placement.frames[link.joint.number, :3, 2] for link in arm.links if link.joint.sigma == REVOLUTE]
    axes += [arm.base[:3, k] for k in (1, 0)]
    steep = [abs(float(axis @ arm.up)) for axis in axes]
    return [axis for axis, s in zip(axes, steep, strict=True) if s < 0.05 or s > 0.95] or axes


def _shown(normal: Array, arm: Skeleton, placement: Placement) -> float:
    """The share of joint axes seen end on, and by how little distances between frames are shortened."""
    axes = [placement.frames[link.joint.number, :3, 2] for link in arm.links if link.joint.sigma == REVOLUTE]
    votes = sum(abs(float(axis @ normal)) > 0.99 for axis in axes) / max(len(axes), 1)
    return votes + 2.0 * _unshortened(normal, placement)


def _unshortened(normal: Array, placement: Placement) -> float:
    """The mean ratio of a distance between two frames in the picture to the true one."""
    origins = placement.frames[:, :3, 3]
    steps = (origins[:, None] - origins[None, :]).reshape(-1, 3)
    lengths = np.linalg.norm(steps, axis=-1)
    steps, lengths = steps[lengths > 1e-6], lengths[lengths > 1e-6]
    flattened = np.linalg.norm(steps - (steps @ normal)[:, None] * normal, axis=-1)
    return float((flattened / lengths).mean()) if len(lengths) else 1.0
