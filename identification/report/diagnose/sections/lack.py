"""How much of each joint's residual no noise explains, before and after."""

from __future__ import annotations

from generator.review.markup import Content, Markup, element, join, table
from identification.report.chart import ESTIMATED, RESIDUAL, axis, chart
from identification.report.diagnose.subject import Subject
from identification.report.diagnose.words import chance
from identification.report.numbers import number
from identification.report.series import numbers

TITLE = "Where: lack of fit of each joint"
ORDER = 20

_NONE = (
    "No joint keeps more than the noise. On short runs that do not repeat, the noise holds part of what the model"
    " lacks; candidates tell more."
)


def render(subject: Subject) -> Markup:
    found = subject.found
    repeats = any(one.repeats for one in found.before.lack)
    how = (
        "What repetitions of the motion have in common, beside what differs between them (an F test)."
        if repeats
        else "The power of the residual beside that of the noise, which is measured on the same rows: weaker evidence"
        " than a motion that repeats would give; where the residual follows the motion, what does beside what does not."
    )
    text = f"{how} A ratio of 1 is a model without fault; the size is what it lacks, in the noise's rms."
    bars = [
        {
            "type": "bar", "name": name, "x": [f"joint {one.joint}" for one in where.lack],
            "y": numbers(one.size for one in where.lack), "marker": {"color": colour},
        }
        for name, where, colour in (("before", found.before, RESIDUAL), ("with the findings", found.after, ESTIMATED))
    ]  # fmt: skip
    layout = {"yaxis": axis("lack of fit in the noise"), "xaxis": axis(""), "bargap": 0.35}
    rows: list[list[Content]] = [
        [
            str(one.joint), number(one.ratio, 4), chance(one.p), number(one.size, 3),
            number(other.ratio, 4), chance(other.p), number(other.size, 3),
            element("span", other.event, class_="state") if other.event else None,
        ]
        for one, other in zip(found.before.lack, found.after.lack, strict=True)
    ]  # fmt: skip
    heads = ("joint", "before: ratio", "p", "size", "with the findings: ratio", "p", "size", "")
    picture = (
        chart(bars, layout, "Lack of fit of each joint before and after", height=250)
        if any(one.size for one in found.before.lack)
        else element("p", _NONE)
    )
    return join(element("p", text), picture, table(heads, rows, class_="numbers"))
