"""Values with their uncertainty."""

from __future__ import annotations

from generator.review.markup import Content, Markup, element, join
from identification.report.parameter_table import parameter_table
from identification.report.stiffness.subject import Subject

TITLE = "Values"
ORDER = 20


def render(subject: Subject) -> Markup:
    values = subject.results["parameters"]
    states: dict[str, Content] = {
        name: element("span", one["refused"], class_="state")
        if one.get("refused")
        else element("span", "" if one["essential"] else "not essential", class_="faint")
        for name, one in values.items()
    }
    text = f"Standard deviations are those {subject.results['method']['std']}."
    return join(element("p", text), parameter_table(values, states))
