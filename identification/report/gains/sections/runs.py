"""The runs and the method."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.gains.subject import Subject
from identification.report.runs_table import runs_table
from identification.report.told import facts

TITLE = "Runs and method"
ORDER = 110


def render(subject: Subject) -> Markup:
    method = subject.results["method"]
    limit = f"gains with a relative std above {method['refused_above_relative_std_percent']:g} %"
    about = {"method": method["name"], "columns": method["columns"], "std": method["std"], "refused": limit}
    return join(runs_table(subject.results["data"]), element("h3", "Method"), facts(about))
