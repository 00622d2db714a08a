"""What a diagnosis changed, as unified diffs: of the robot file and of the groupings of its base parameters."""

from __future__ import annotations

import difflib

from generator.backends.review import groupings
from generator.symbolic.model import Model


def difference(old: str, new: str, name: str) -> str:
    """A unified diff of two texts; empty where they are the same."""
    lines = difflib.unified_diff(
        old.splitlines(keepends=True), new.splitlines(keepends=True), f"{name} before", f"{name} after"
    )
    return "".join(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines)


def groupings_difference(old: Model, new: Model) -> str:
    """A unified diff of review/groupings.md."""
    return difference(groupings(old), groupings(new), "groupings.md")
