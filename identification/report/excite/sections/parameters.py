"""What will be known of each parameter."""

from __future__ import annotations

from generator.review.markup import Content, Markup, element, join
from identification.excitation.results import Excitation, document
from identification.report.parameter_table import parameter_table

TITLE = "Expected standard deviations"
ORDER = 30


def render(found: Excitation) -> Markup:
    expected = document(found)["expected"]
    states: dict[str, Content] = {
        name: None if one["identifiable"] else element("span", "this motion does not show it", class_="state")
        for name, one in expected.items()
    }
    text = (
        "Those of identify on this motion, for independent noise; values are those of the set"
        f" {found.request.parameters}, to which deviations are related."
    )
    return join(element("p", text), parameter_table(expected, states))
