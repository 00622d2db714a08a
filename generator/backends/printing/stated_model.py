"""The model in the lines of a comment, so that vendored code says what it was derived from."""

from __future__ import annotations

from collections.abc import Sequence

from generator.backends.printing.language import LINE
from generator.backends.printing.signals import paragraph
from generator.review import stated
from generator.review.documents import geometry
from generator.review.geometry import length_value
from generator.review.groupings import equations
from generator.review.plain import plain
from generator.symbolic.model import Model

_FRAMES = (
    "Frame j follows from its antecedent a(j) by Rot(z, gamma) Trans(z, b) Rot(x, alpha) Trans(x, d) Rot(z, theta) "
    "Trans(z, r), in which gamma and b are 0 if they are not shown. sigma is 0 for a revolute joint, 1 for a prismatic "
    "one, 2 for a fixed frame; a frame's name follows its number."
)
#: Columns before a line of the comment, and how far a title's text is indented in it.
_BEFORE, _INDENT = 5, 10


def stated_model(model: Model) -> list[str]:
    """Free fall, pose of frame 0, Denavit-Hartenberg table with its lengths, and the groupings, a title before each."""
    robot = model.robot
    pose = stated.base(robot)
    frame_0 = ", in which frame 0 has the pose" if pose else ", which is frame 0."
    lengths = ", ".join(f"{length.name} = {length_value(length)}" for length in robot.lengths)
    parts = {
        "Gravity": [f"Free fall is ({stated.gravity(robot)}) m/s2 in the world frame{frame_0}", *pose],
        "Geometry": [*_wrapped(_FRAMES), *_columns(geometry(robot)), *_wrapped(lengths)],
        "Groupings": [line for _, symbolic, _ in equations(model.grouping) for line in _wrapped(plain(symbolic), 4)],
    }
    return [line for title, lines in parts.items() for line in _titled(title, lines)]


def _titled(title: str, lines: Sequence[str]) -> list[str]:
    return [f"{title if i == 0 else '':<{_INDENT}}{line}" for i, line in enumerate(lines)]


def _wrapped(text: str, hanging: int = 0) -> list[str]:
    return paragraph(text, LINE - _BEFORE - _INDENT, hanging)


def _columns(table: stated.Table) -> list[str]:
    """Rows with their cells one below the other."""
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in table]
