"""Labels that keep clear of the drawing and of each other."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from generator.review.formula import Name
from generator.review.markup import Markup, element, join
from generator.review.picture.view import Point
from generator.review.svg import points, subscripted, text

_HALF_HEIGHT = 7.0
_WIDTH = 7.4
_DISTANCES = (13.0, 17.0, 22.0, 28.0, 36.0, 46.0, 60.0)
_DIRECTIONS = 24
#: Distance between the points that stand for what is drawn.
_GRAIN = 4.0
#: From this distance on a thin line leads from the label to what it names.
_LEADER = 18.0

#: Left, top, right, bottom.
Box = tuple[float, float, float, float]


@dataclass
class Sheet:
    """What has been drawn so far, as points to stay clear of and boxes not to overlap."""

    width: float
    height: float
    obstacles: list[Point] = field(default_factory=list)
    boxes: list[Box] = field(default_factory=list)

    def occupy(self, path: Iterable[Point], radius: float = 0.0) -> None:
        """Marks a polyline as drawn, as wide as twice ``radius``."""
        for start, end in itertools.pairwise(path):
            dx, dy = end[0] - start[0], end[1] - start[1]
            length = math.hypot(dx, dy)
            if length < 1e-6:
                continue
            across = (-dy / length, dx / length)
            count = max(1, math.ceil(length / _GRAIN))
            for side in _steps(radius):
                for k in range(count + 1):
                    at = k / count
                    self.obstacles.append(
                        (start[0] + dx * at + side * across[0], start[1] + dy * at + side * across[1])
                    )

    def occupy_disc(self, centre: Point, radius: float) -> None:
        """Marks a disc as drawn."""
        for x in _steps(radius):
            for y in _steps(radius):
                if math.hypot(x, y) <= radius:
                    self.obstacles.append((centre[0] + x, centre[1] + y))

    def label(
        self, names: Iterable[Name], anchor: Point, kind: str, *, prefer: Point = (0.0, 0.0), clear: float = 0.0
    ) -> Markup:
        """Text near ``anchor``, where it disturbs least; ``prefer`` is a direction to lean to, ``clear`` the radius
        around the anchor at which a leader ends.
        """
        listed = list(names)
        half_width = max(_WIDTH, _WIDTH * sum(_letters(name) for name in listed) / 2 + 5.0 * (len(listed) - 1))
        x, y = self._quietest(anchor, half_width, prefer)
        self.boxes.append((x - half_width, y - _HALF_HEIGHT, x + half_width, y + _HALF_HEIGHT))
        words = text(x, y + 4.5, subscripted(listed), kind=f"label {kind}")
        far = math.hypot(x - anchor[0], y - anchor[1])
        if far - half_width - clear < _LEADER:
            return words
        outer, inner = (half_width + 2.0) / far, clear / far
        start = (x + (anchor[0] - x) * outer, y + (anchor[1] - y) * outer)
        end = (anchor[0] + (x - anchor[0]) * inner, anchor[1] + (y - anchor[1]) * inner)
        self.occupy([start, end])
        return join(element("path", class_="leader", d=f"M {points([start])} L {points([end])}"), words)

    def _quietest(self, anchor: Point, half_width: float, prefer: Point) -> Point:
        """The place around ``anchor`` with the least crossed, overlapped and left behind."""
        distance, angle = np.meshgrid(_DISTANCES, 2 * np.pi * np.arange(_DIRECTIONS) / _DIRECTIONS, indexing="ij")
        dx = ((distance + half_width - _WIDTH) * np.cos(angle)).ravel()
        dy = (distance * np.sin(angle)).ravel()
        x, y = np.round(anchor[0] + dx + 1e-5, 1), np.round(anchor[1] + dy + 1e-5, 1)
        box = np.stack([x - half_width, y - _HALF_HEIGHT, x + half_width, y + _HALF_HEIGHT])
        limits = np.array([[4.0, 4.0], [self.width - 4.0, self.height - 4.0]])
        outside = np.maximum(limits[0][:, None] - box[:2], 0).sum(axis=0)
        outside += np.maximum(box[2:] - limits[1][:, None], 0).sum(axis=0)
        px, py = np.round(np.array(self.obstacles or [(-99.0, -99.0)]).T, 1)
        inside = (abs(px - x[:, None]) < half_width + 2) & (abs(py - y[:, None]) < _HALF_HEIGHT + 2)
        overlap = np.zeros_like(x)
        for left, top, right, bottom in self.boxes:
            wide = np.minimum(box[2], right) - np.maximum(box[0], left) + 3
            high = np.minimum(box[3], bottom) - np.maximum(box[1], top) + 1
            overlap += np.maximum(wide, 0) * np.maximum(high, 0)
        away = np.hypot(dx, dy)
        lean = (dx * prefer[0] + dy * prefer[1]) / away
        cost = 50 * outside + 9 * inside.sum(axis=1) + 4 * overlap + 0.5 * away - 7 * lean
        best = int(np.argmin(np.round(cost, 2)))
        return float(x[best]), float(y[best])


def _steps(radius: float) -> list[float]:
    count = math.ceil(radius / _GRAIN)
    return [radius * k / count for k in range(-count, count + 1)] if count else [0.0]


def _letters(name: Name) -> float:
    stem, below = name.parts
    return len(stem if len(stem) < 4 else "x") + 0.8 * len(below)
