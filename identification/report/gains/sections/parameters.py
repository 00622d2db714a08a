"""Gains and parameters with their uncertainty."""

from __future__ import annotations

from generator.review.markup import Content, Markup, element, join
from identification.report.gains.subject import Subject
from identification.report.numbers import plain
from identification.report.parameter_table import parameter_table

TITLE = "Gains and parameters"
ORDER = 20


def render(subject: Subject) -> Markup:
    results = subject.results
    gains, others = subject.gains, subject.parameters
    states: dict[str, Content] = {
        name: element("span", one["refused"], class_="state")
        for name, one in {**gains, **others}.items()
        if one.get("refused")
    }
    states |= {
        name: element("span", f"{plain(share, 2)}\u202f% come from the payload's", class_="faint")
        for name, share in results["gains_by_payload_percent"].items()
        if share
    }
    text = f"Standard deviations: {results['method']['std']}."
    return join(
        element("p", text),
        parameter_table(gains, states),
        element("h3", "Parameters"),
        parameter_table(others, states),
    )
