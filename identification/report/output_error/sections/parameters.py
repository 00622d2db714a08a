"""All parameters with their uncertainty, beside those that the search began with."""

from __future__ import annotations

from generator.review.markup import Content, Markup, element, join
from identification.report.output_error.subject import Subject
from identification.report.parameter_table import parameter_table

TITLE = "Parameters"
ORDER = 30


def render(subject: Subject) -> Markup:
    best, parameters = subject.found.best, subject.results["parameters"]
    states: dict[str, Content] = {
        name: element("span", "given", class_="faint")
        if name not in best.names
        else element("span", "no position shows it alone", class_="state")
        if name in best.hidden
        else None
        for name in parameters
    }
    text = (
        f"Standard deviations are those of {subject.results['method']['std']}. Beside them, what the inverse dynamic"
        " model and least squares make of the same runs."
    )
    beside = {"inverse model": subject.found.first.full.solution.values}
    return join(element("p", text), parameter_table(parameters, states, beside))
