"""What changed in the robot file and in the groupings of its base parameters."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.choice import choice
from identification.report.diagnose.subject import Subject

TITLE = "What changed in the robot file"
ORDER = 90

_KINDS = {"+": "added", "-": "removed", "@": "place"}


def render(subject: Subject) -> Markup | None:
    mended = subject.mended
    if mended is None:
        return None
    diffs = {"robot file": mended.file_difference, "groupings": mended.groupings_difference}
    panels = {name: _diff(text) if text else element("p", "Nothing changed.") for name, text in diffs.items()}
    where = element(
        "p", "The code of the new model is in ", element("code", mended.generated.as_posix()), ", regenerated."
    )
    return join(choice("difference", "Difference of", panels), where)


def _diff(text: str) -> Markup:
    """A unified diff, a span a line."""
    lines = [element("span", one or " ", class_=_kind(one)) for one in text.splitlines()]
    return element("pre", lines, class_="diff")


def _kind(line: str) -> str | None:
    return "place" if line[:3] in ("---", "+++") else _KINDS.get(line[:1])
