"""What to expect, in words and a few numbers."""

from __future__ import annotations

from collections.abc import Iterator

from generator.review.markup import Markup, element, join
from generator.words import listed
from identification.excitation.results import Excitation
from identification.report.numbers import card, number, plain

TITLE = "Summary"
ORDER = 10


def render(found: Excitation) -> Markup:
    solution = found.expected
    cards = [
        card(f"{found.duration:g}\u202fs", "motion", f"{found.request.periods} periods, {found.request.rate:g} Hz"),
        card(number(solution.scaled_condition, 3), "condition number", "of W, columns of unit length"),
    ]
    if found.limits.loads.size:
        cards.append(
            card(f"{plain(100 * found.design.load, 3)}\u202f%", "largest load", "of the tightest torque limit")
        )
    return join(element("p", " ".join(_text(found)), class_="verdict"), element("div", cards, class_="cards results"))


def _text(found: Excitation) -> Iterator[str]:
    solution = found.expected
    known = {
        name: solution.relative_std(name)
        for name in found.units
        if name not in solution.hidden and solution.values[name]
    }
    zero = [name for name in found.units if name not in solution.hidden and not solution.values[name]]
    good = sum(one < 10 for one in known.values())
    yield f"Of {len(found.units)} base parameters {good} will be known to 10\u202f% or better."
    if known:
        best, worst = min(known, key=known.__getitem__), max(known, key=known.__getitem__)
        yield f"Best known will be {best}, to {plain(known[best], 2)}\u202f%, least known {worst},"
        yield f"to {plain(known[worst], 2)}\u202f%."
    if zero:
        have = "are 0 in the set of values and have" if len(zero) > 1 else "is 0 in the set of values and has"
        yield f"{listed(zero)} {have} no relative standard deviation."
    if solution.hidden:
        yield f"This motion does not show {listed(solution.hidden)}."
