"""The residual over what an effect may depend on, with the band that noise would fill."""

from __future__ import annotations

from collections.abc import Sequence

from generator.review.markup import Markup, element, join
from identification.diagnosis.verdict.views import View
from identification.report.chart import COLOURS, INK, MEASURED, Trace, axis, band, chart, line
from identification.report.choice import choice
from identification.report.diagnose.subject import Subject
from identification.report.numbers import plain
from identification.report.series import numbers

TITLE = "Where: residual over position, speed, load, time"
ORDER = 30

_DIRECTIONS = {-1: ("moving backward", COLOURS[1]), 0: ("before", COLOURS[0]), 1: ("moving forward", COLOURS[0])}


def render(subject: Subject) -> Markup:
    text = (
        "Means of the residual in bins, of the runs that are fitted and that validate. Full lines are the model before,"
        " dotted ones the model with the findings; bands are two standard deviations of what noise would do to a mean,"
        " one for each direction where two are shown. The share tells how much of the residual's variance the variable"
        " orders, beyond chance."
    )
    before, after = subject.found.before.views, subject.found.after.views
    leading = subject.found.before.variable
    panels = {
        f"{number}": choice("variable", "Over", _panels(subject, number, before[number], after[number]), leading)
        if before[number]
        else element("p", f"Joint {number} has too few rows.")
        for number in subject.numbers
    }
    return join(element("p", text), choice("joint", "Joint", panels, subject.leading))


def _panels(subject: Subject, joint: int, before: Sequence[View], after: Sequence[View]) -> dict[str, Markup]:
    """By variable, the one that orders most first."""
    return {
        variable: _chart(
            subject, joint, [one for one in before if one.variable == variable],
            [one for one in after if one.variable == variable],
        )
        for variable in dict.fromkeys(one.variable for one in before)
    }  # fmt: skip


def _chart(subject: Subject, joint: int, before: Sequence[View], after: Sequence[View]) -> Markup:
    first = before[0]
    data: list[Trace] = []
    for one in before:
        colour = _DIRECTIONS[one.direction][1] if one.direction else MEASURED
        data += band(numbers(one.centre), numbers(-one.band), numbers(one.band), colour)
    for one in before:
        name, colour = _DIRECTIONS[one.direction]
        data.append(line(numbers(one.centre), numbers(one.mean), name, colour, line={"width": 2.2}))
    for one in after:
        name, colour = _DIRECTIONS[one.direction] if one.direction else ("", INK)
        style = {"width": 1.6, "dash": "dot"}
        name = f"{name}, with the findings".strip(", ")
        data.append(line(numbers(one.centre), numbers(one.mean), name, colour, line=style))
    last = max((one.share for one in after), default=0.0)
    shares = [plain(100 * share, 3) for share in (first.share, last)]
    caption = f"Share of the variance: {shares[0]}\u202f% before, {shares[1]}\u202f% with the findings."
    layout = {
        "xaxis": axis(_named(first.variable, joint), first.unit),
        "yaxis": axis(f"residual of joint {joint}", subject.torque_units[joint]),
    }
    return chart(data, layout, f"Residual of joint {joint} over {first.variable}", caption, height=340)


def _named(variable: str, joint: int) -> str:
    names = {"q": f"q{joint}", "q by direction": f"q{joint}", "qd": f"qd{joint}", "qdd": f"qdd{joint}"}
    return names.get(variable, variable)
