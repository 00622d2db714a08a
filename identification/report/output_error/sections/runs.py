"""The runs and the method."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.output_error.subject import Subject
from identification.report.runs_table import runs_table
from identification.report.told import facts

TITLE = "Runs and method"
ORDER = 110


def render(subject: Subject) -> Markup:
    results = subject.results
    method = results["method"]
    about = {
        "minimisation": method["minimisation"],
        "weights": method["weights"],
        "std": method["std"],
        "search": f"{method['iterations']} iterations, {method['simulations']} simulations",
    }
    kinds = {"fitted": results["data"]["train"], "held out": results["data"]["test"]}
    return join(runs_table(kinds), element("h3", "Method"), facts(about))
