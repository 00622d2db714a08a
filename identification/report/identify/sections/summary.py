"""What was found, in words and a few numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from generator.review.markup import Markup, element, join
from generator.words import listed, plural
from identification.report.identify.subject import ALL, Subject
from identification.report.numbers import card, number, percent, plain
from identification.report.told import notes

TITLE = "Summary"
ORDER = 10

#: Residual of held-out rows, in that of the fitted ones, from which the difference is worth a sentence.
_WORSE = 1.5


def render(subject: Subject) -> Markup:
    return join(
        element("p", " ".join(_quality(subject)), class_="verdict"),
        element("p", " ".join(_parameters(subject))),
        element("p", " ".join(_positivity(subject))),
        element("div", _cards(subject), class_="cards results"),
        notes(subject.results["notes"]),
    )


def _quality(subject: Subject) -> Iterator[str]:
    residual = subject.residuals[ALL]
    fitted, held_out = residual["train"], residual["test"]
    empty = held_out is not None and not held_out["total"]["rows"]
    held_out = None if empty else held_out
    left = fitted["total"]["relative_to_mean_percent"]
    count = sum(not run.held_out for run in subject.runs)
    yield f"The model leaves {plain(left, 3)}\u202f% of the torques unexplained on the {plural(count, 'run')} fitted"
    if held_out is None:
        why = "No row that was held out counts" if empty else "No run was held out"
        yield f"(‖e‖ / ‖Y − mean Y‖, all joints). {why}, so nothing tells how it carries over."
        judged = fitted
    else:
        yield f"and {plain(held_out['total']['relative_to_mean_percent'], 3)}\u202f% on what was held out"
        yield "(‖e‖ / ‖Y − mean Y‖, all joints)."
        judged = held_out
    each = {one["joint"]: one["relative_to_mean_percent"] for one in judged["per_joint"] if one["rows"]}
    if len(each) > 1:
        worst = max(each, key=each.__getitem__)
        yield f"Joint {worst} is explained least, with {plain(each[worst], 3)}\u202f% left."
    if held_out is not None:
        ratio = _growth(fitted, held_out)
        if ratio > _WORSE:
            yield f"A row held out leaves {plain(ratio, 2)} times as much torque as a fitted one, each joint in what it"
            yield "leaves there: the fitted runs do not show all that matters."


def _growth(fitted: Mapping[str, Any], held_out: Mapping[str, Any]) -> float:
    """Root mean square of the residuals held out, each joint's in that of its fitted rows.

    Percentages do not compare: a run with little motion has little torque to explain and as much noise as any.
    """
    usual = {one["joint"]: one["norm"] ** 2 / one["rows"] for one in fitted["per_joint"] if one["rows"]}
    both = [one for one in held_out["per_joint"] if one["rows"] and usual.get(one["joint"])]
    rows = sum(one["rows"] for one in both)
    return math.sqrt(sum(one["norm"] ** 2 / usual[one["joint"]] for one in both) / rows) if rows else 1.0


def _parameters(subject: Subject) -> Iterator[str]:
    all_ = subject.results["parameters"]
    hidden = [name for name, one in all_.items() if not one["identifiable"]]
    fixed = [name for name, one in all_.items() if one["fixed"]]
    certain = {
        name: one["relative_std_percent"]
        for name, one in all_.items()
        if one["identifiable"] and not one["fixed"] and one["value"]
    }
    yield f"{len(all_) - len(hidden) - len(fixed)} of {plural(len(all_), 'base parameter')} are identified;"
    yield f"{sum(one['essential'] for one in all_.values())} are essential."
    if fixed:
        yield f"{listed(fixed)} {'was' if len(fixed) == 1 else 'were'} given and not identified."
    if hidden:
        yield f"No motion in the data shows {listed(hidden)}."
    if certain:
        best, worst = min(certain, key=certain.__getitem__), max(certain, key=certain.__getitem__)
        yield f"Best known is {best}, to {plain(certain[best], 2)}\u202f%, least known {worst},"
        yield f"to {plain(certain[worst], 2)}\u202f%."


def _positivity(subject: Subject) -> Iterator[str]:
    """Which models have a positive inertia matrix along the runs."""
    lowest = {
        model: min(float(np.min(values)) for _, values in runs.values()) for model, runs in subject.eigenvalues.items()
    }
    good = [model for model, least in lowest.items() if least > 0]
    bad = [model for model, least in lowest.items() if least <= 0]
    if not bad:
        yield f"The inertia matrix is positive definite along all runs with {listed(good)}."
    elif good:
        yield f"The inertia matrix is positive definite along all runs with {listed(good)},"
        yield f"but not with {listed(bad)}, which a simulation must not use."
    else:
        yield f"The inertia matrix is not positive definite along the runs with {listed(bad)}:"
        yield "a simulation must not use them."


def _cards(subject: Subject) -> Iterator[Markup]:
    for model, residual in subject.residuals.items():
        total = {kind: residual[kind]["total"] for kind in ("train", "test") if residual[kind] is not None}
        last = "test" if "test" in total else "train"
        where = "left on held-out runs" if last == "test" else "left on fitted runs"
        yield card(percent(total[last]["relative_to_mean_percent"]), where, model)
    solution = subject.found.full.solution
    yield card(number(solution.scaled_condition, 3), "condition number", "of W, columns of unit length")
