"""What was found, in words and a few numbers."""

from __future__ import annotations

from collections.abc import Iterator

from generator.review.markup import Markup, element, join
from generator.words import listed, plural
from identification.report.numbers import card, number, percent, plain
from identification.report.output_error.subject import Subject
from identification.report.told import notes

TITLE = "Summary"
ORDER = 10


def render(subject: Subject) -> Markup:
    return join(
        element("p", " ".join(_text(subject)), class_="verdict"),
        element("div", list(_cards(subject)), class_="cards results"),
        notes(subject.results["notes"]),
    )


def _text(subject: Subject) -> Iterator[str]:
    best, residual = subject.found.best, subject.results["residual"]
    left = residual["train"]["total"]["relative_to_mean_percent"]
    yield f"The simulated positions miss {plain(left, 3)}\u202f% of the measured ones' spread on the fitted runs"
    if residual["test"] is None:
        yield "(‖e‖ / ‖q − mean q‖, all joints). No run was held out."
    else:
        tested = residual["test"]["total"]["relative_to_mean_percent"]
        yield f"and {plain(tested, 3)}\u202f% on what was held out (‖e‖ / ‖q − mean q‖, all joints)."
    if best.hidden:
        yield f"No position shows {listed(best.hidden)}."
    where = "where its constraint holds it" if best.limited else "away from its constraint"
    yield f"The inertia matrix is positive definite along the runs, {where}."
    starts = len(subject.found.scores)
    if starts > 1:
        yield f"The best of {plural(starts, 'start')} is {subject.found.chosen}."


def _cards(subject: Subject) -> Iterator[Markup]:
    best, residual = subject.found.best, subject.results["residual"]
    kind = "train" if residual["test"] is None else "test"
    where = "fitted runs" if kind == "train" else "held-out runs"
    yield card(percent(residual[kind]["total"]["relative_to_mean_percent"]), f"missed on {where}", "positions")
    yield card(str(len(best.names)), "parameters", f"{len(best.hidden)} not shown")
    yield card(number(best.condition, 3), "condition number", "of the sensitivities, columns of unit length")
    yield card(str(best.simulations), "simulations", plural(best.iterations, "iteration"))
