"""What the picture is made of: tubes, cylinders, boxes and arrows, each projected and drawn as SVG."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from generator.review.markup import Markup, element, join
from generator.review.picture.skeleton import Array
from generator.review.picture.view import Point, View
from generator.review.svg import pixel, points

#: Corners of a face in order.
_LOOP = [(-1, -1), (1, -1), (1, 1), (-1, 1)]


def tube(paths: Sequence[Sequence[Point]], width: float) -> Markup:
    """Thick polylines that belong together: one outline around them all."""
    outlines = [_stroke(path, "tube-edge", width) for path in paths]
    insides = [_stroke(path, "tube", width - 3.0) for path in paths]
    return join(outlines, insides)


def cylinder(view: View, centre: Point, axis: Array, radius: float, half: float, title: str, kind: str) -> Markup:
    """A cylinder about the unit vector ``axis``; ``radius`` and ``half`` length in pixels."""
    along = view.direction(axis)
    towards = float(view.rows[2] @ axis)
    if towards < 0:
        along, towards = (-along[0], -along[1]), -towards
    foreshortened = math.hypot(*along)
    angle = math.atan2(along[1], along[0]) if foreshortened > 1e-6 else 0.0
    normal = (-math.sin(angle) * radius, math.cos(angle) * radius)
    near = (centre[0] + half * along[0], centre[1] + half * along[1])
    far = (centre[0] - half * along[0], centre[1] - half * along[1])
    cap_width = radius * towards
    corners = [_plus(far, normal, 1), _plus(far, normal, -1), _plus(near, normal, -1), _plus(near, normal, 1)]
    first, second, third, fourth = ("{} {}".format(*map(pixel, corner)) for corner in corners)
    arc = f"A {pixel(cap_width)} {pixel(radius)} {pixel(math.degrees(angle))} 0"
    side = element("path", class_=f"{kind}-side", d=f"M {first} {arc} 1 {second} L {third} {arc} 0 {fourth} Z")
    cap = element(
        "ellipse",
        class_=f"{kind}-cap",
        rx=pixel(max(cap_width, 0.05)),
        ry=pixel(radius),
        transform=f"translate({pixel(near[0])} {pixel(near[1])}) rotate({pixel(math.degrees(angle))})",
    )
    return element("g", element("title", title), side, cap)


def box(view: View, centre: Array, axes: Array, halves: tuple[float, float, float], title: str, kind: str) -> Markup:
    """A box with edges along the columns of ``axes``; ``halves`` are half its edges in pixels."""
    middle = view(centre)
    faces = []
    for axis in range(3):
        others = [(axis + 1) % 3, (axis + 2) % 3]
        towards = float(view.rows[2] @ axes[:, axis])
        if abs(towards) < 1e-6:
            continue
        sign = 1 if towards > 0 else -1
        outline = []
        for a, b in _LOOP:
            offset = axes[:, axis] * (sign * halves[axis])
            offset = (
                offset + axes[:, others[0]] * (a * halves[others[0]]) + axes[:, others[1]] * (b * halves[others[1]])
            )
            right, down = float(view.rows[0] @ offset), -float(view.rows[1] @ offset)
            outline.append((middle[0] + right, middle[1] + down))
        kind_of_face = f"{kind}-cap" if axis == 2 else f"{kind}-side"
        faces.append(element("polygon", class_=kind_of_face, points=points(outline)))
    return element("g", element("title", title), faces)


def arrow(start: Point, end: Point, kind: str, head: float = 7.0) -> Markup:
    """A straight arrow; what is too short for its head becomes the head alone."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    ux, uy = dx / length, dy / length
    neck = (end[0] - head * ux, end[1] - head * uy)
    wing = 0.42 * head
    tip = [end, (neck[0] - wing * uy, neck[1] + wing * ux), (neck[0] + wing * uy, neck[1] - wing * ux)]
    shaft = element("path", class_=kind, d=f"M {points([start])} L {points([neck])}") if length > head else None
    return join(shaft, element("polygon", class_=f"{kind} head", points=points(tip)))


def towards_viewer(centre: Point, kind: str, *, away: bool) -> Markup:
    """The sign of a vector seen end on: a dot for its tip, a cross for its tail."""
    x, y = centre
    ring = element("circle", class_=f"{kind} ring", cx=pixel(x), cy=pixel(y), r="5.5")
    if not away:
        return join(ring, element("circle", class_=f"{kind} head", cx=pixel(x), cy=pixel(y), r="2"))
    reach = 3.2
    strokes = [line((x - reach, y - side * reach), (x + reach, y + side * reach), kind) for side in (1, -1)]
    return join(ring, strokes)


def circle(view: View, centre: Array, frame: Array, radius: float) -> list[Point]:
    """A good half turn about z of ``frame`` in the positive sense; ``radius`` in pixels."""
    middle = view(centre)
    track = []
    for angle in np.linspace(-0.35 * np.pi, 0.75 * np.pi, 23):
        across = view.direction(frame[:, 0] * math.cos(angle) + frame[:, 1] * math.sin(angle))
        track.append((middle[0] + radius * across[0], middle[1] + radius * across[1]))
    return track


def bent_arrow(track: Sequence[Point], kind: str) -> Markup:
    """A polyline that ends in an arrow head."""
    return join(
        element("polyline", class_=kind, points=points(track[:-2])), arrow(track[-3], track[-1], kind, head=6.5)
    )


def line(start: Point, end: Point, kind: str) -> Markup:
    """A straight line."""
    return element("path", class_=kind, d=f"M {points([start])} L {points([end])}")


def _stroke(path: Sequence[Point], kind: str, width: float) -> Markup:
    return element("polyline", class_=kind, stroke_width=pixel(width), points=points(path))


def _plus(point: Point, offset: Point, factor: int) -> Point:
    return (point[0] + factor * offset[0], point[1] + factor * offset[1])
