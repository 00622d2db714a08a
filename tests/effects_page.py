"""``python -m tests.effects_page`` puts the library of effects into docs/effects.md; ``git diff`` then shows it."""

from __future__ import annotations

from generator.review.effect_page import page
from tests.documents import ROOT

PATH = ROOT / "docs" / "effects.md"
_HEADING = "## The library\n\n"


def with_library(text: str) -> str:
    """The document with the library of today below its last heading."""
    before, heading, _ = text.partition(_HEADING)
    assert heading, f"{PATH} has no heading {_HEADING.strip()!r}"
    return before + heading + page()


if __name__ == "__main__":
    PATH.write_text(with_library(PATH.read_text(encoding="utf-8")), encoding="utf-8")
