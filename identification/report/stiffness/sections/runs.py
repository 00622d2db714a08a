"""The runs and the method."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.runs_table import runs_table
from identification.report.stiffness.subject import Subject
from identification.report.told import facts

TITLE = "Runs and method"
ORDER = 110


def render(subject: Subject) -> Markup:
    method = subject.results["method"]
    limit = f"relative std above {method['refused_above_relative_std_percent']:g} %"
    about = {"method": method["name"], "std": method["std"], "refused": limit}
    if "wrench" in method:
        about["wrench"] = " ".join(method["wrench"])
    if "balancer_torque" in method:
        about["balancer"] = ", ".join(f"{one:.6g}" for one in method["balancer_torque"]) + " subtracted, run by run"
    return join(runs_table({"fitted": subject.results["data"]["train"]}), element("h3", "Method"), facts(about))
