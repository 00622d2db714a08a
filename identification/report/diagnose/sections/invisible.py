"""Effects that this data cannot show, and what would."""

from __future__ import annotations

from generator.review.markup import Content, Markup, element, join, table
from identification.report.diagnose.subject import Subject

TITLE = "Invisible on this data"
ORDER = 110


def render(subject: Subject) -> Markup | None:
    invisible = subject.found.invisible
    if not invisible:
        return None
    grouped: dict[tuple[str, str], list[str]] = {}
    for one in invisible:
        where = [str(number) for number in one.numbers if number]
        grouped.setdefault((one.title, one.would_show), []).extend(where)
    rows: list[list[Content]] = [
        [title, ", ".join(dict.fromkeys(numbers)) or "robot", show or "more motion: other ranges, speeds and loads"]
        for (title, show), numbers in grouped.items()
    ]
    text = (
        "Of these effects the model's own parameters take up nearly all, or they make no torque along these"
        " runs: whether they are there cannot be told, and nothing is said about them."
    )
    return join(element("p", text), table(("effect", "joints", "what would show it"), rows, class_="remarks"))
