"""How many parameters agree."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from generator.words import plural
from identification.comparison import AGREE, Comparison
from identification.report.numbers import plain

TITLE = "Summary"
ORDER = 10


def render(found: Comparison) -> Markup:
    common = list(found.common)
    told = [one for one in common if one.agrees is not None]
    agreeing = [one for one in told if one.agrees]
    text = [f"{plural(len(common), 'parameter')} in common."]
    if told:
        text.append(f"{len(agreeing)} of {len(told)} with a standard deviation agree within {AGREE:g} of them.")
        worst = max(told, key=lambda one: one.deviations or 0.0)
        if not worst.agrees:
            text.append(f"Furthest apart is {worst.name}, by {plain(worst.deviations or 0.0, 3)}.")
    more = "Differences are 100 |b − a| / |a| (report eq. 79); standard deviations are those of the difference of"
    return join(element("p", " ".join(text), class_="verdict"), element("p", f"{more} independent estimates."))
