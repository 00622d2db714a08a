"""The runs, the method and what the estimates owe to the filters."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Content, Markup, element, join, table
from identification.report.identify.subject import Subject
from identification.report.numbers import plain
from identification.report.runs_table import runs_table
from identification.report.told import facts

TITLE = "Runs and method"
ORDER = 110


def render(subject: Subject) -> Markup:
    results = subject.results
    method = results["method"]
    about = {
        "method": "inverse dynamic model, least squares (report eq. 39-46)",
        "weights": method["least_squares"] + (", Huber's weights against outliers" if method["robust"] else ""),
        "std": method["std"],
        "residual variance": method["residual_variance"],
        "standstill": f"rows of joints slower than {_slowest(subject)} are left out",
        "essential": _elimination(subject),
        "given": ", ".join(f"{name} = {plain(value, 6)}" for name, value in method["fixed"].items()) or "nothing",
    }
    kinds = {"fitted": results["data"]["train"], "held out": results["data"]["test"]}
    return join(runs_table(kinds), element("h3", "Method"), facts(about), _sensitivity(subject))


def _elimination(subject: Subject) -> str:
    """The rule by which parameters were taken away, and the ratio of relative standard deviations that it reached."""
    asked, best = subject.results["essential"], subject.found.essential
    relative = [best.solution.relative_std(name) for name in best.sought]
    growth = f" or the residual would grow by more than {100 * asked['growth']:g} %" if asked["growth"] < np.inf else ""
    smallest, largest = min(relative, default=0.0), max(relative, default=0.0)
    reached = f": it is {plain(largest / smallest, 3)}" if smallest > 0 else ""
    return (
        f"until the ratio of relative standard deviations is below {asked['ratio']:g}{growth} (report eq. 47){reached}"
    )


def _slowest(subject: Subject) -> str:
    """The joints' thresholds, once where they are the same."""
    limits = [
        f"{limit:g} {unit}/s"
        for limit, unit in zip(subject.results["method"]["standstill"], subject.position_units.values(), strict=True)
    ]
    return limits[0] if len(set(limits)) == 1 else f"{', '.join(limits)} (joint by joint)"


def _sensitivity(subject: Subject) -> Markup | None:
    found = subject.results["sensitivity"]
    if not found:
        return None
    rows: list[list[Content]] = [
        [f"{one['setting']} {one['value']:g}", f"{plain(one['change'], 3)} std", element("code", one["parameter"])]
        for one in found
    ]
    heads = ("other filters", "largest change of a parameter", "which")
    return join(element("h3", "Sensitivity to the filters"), table(heads, rows, class_="numbers"))
