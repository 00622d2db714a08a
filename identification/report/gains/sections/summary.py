"""What was found, in words."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from generator.words import listed
from identification.report.gains.subject import Subject
from identification.report.numbers import card, number, percent, plain
from identification.report.told import notes

TITLE = "Summary"
ORDER = 10


def render(subject: Subject) -> Markup:
    found, results = subject.found, subject.results
    constants = {name: one for name, one in subject.gains.items() if name.startswith("kt")}
    known = {name: one for name, one in constants.items() if one["value"] is not None}
    refused = [name for name in constants if name not in known]
    total = results["residual"]["train"]["total"]
    worst = max(known, key=lambda name: known[name]["relative_std_percent"])
    text = [
        f"{len(known)} of {len(found.robot.moving)} torque constants are told, the least certain, {worst}, to"
        f" {plain(known[worst]['relative_std_percent'], 2)}\u202f%.",
        f"{listed(refused)} cannot be told from these runs." if refused else "",
        f"The model leaves {plain(total['relative_to_mean_percent'], 3)}\u202f% of the motors' torques unexplained"
        " (‖e‖ / ‖Y − mean Y‖).",
    ]
    apart = (
        "The second smallest singular value over the smallest tells how clearly one set of gains stands out: near 1"
        " their ratios are weakly seen."
    )
    cards = [
        card(f"{len(known)}", "torque constants", f"{len(refused)} refused"),
        card(percent(total["relative_to_mean_percent"]), "left on fitted runs", "motor side"),
        card(number(results["separation"], 3), "separation", "of the singular values"),
    ]
    return join(
        element("p", " ".join(filter(None, text)), class_="verdict"),
        element("p", apart),
        element("div", cards, class_="cards results"),
        notes(results["notes"]),
    )
