"""Numbers for readers, each with its full value in the markup."""

from __future__ import annotations

import math

from generator.review.decimals import scientific
from generator.review.markup import Markup, element
from generator.words import minus

#: What stands where there is no number.
NONE = "–"


def number(value: float | None, digits: int = 5) -> Markup:
    """A number to so many significant digits; a dash for None, a sign for infinity."""
    if value is None:
        return element("span", NONE, class_="faint")
    return element("data", plain(value, digits), value=repr(float(value)))


def plain(value: float, digits: int = 5) -> str:
    """The same without markup; a dash for what is no number."""
    if math.isnan(value):
        return NONE
    if not math.isfinite(value):
        return "∞" if value > 0 else "−∞"
    return minus(scientific(value, digits))


def percent(value: float | None, digits: int = 3) -> Markup:
    """A number that is in %."""
    return element("span", number(value, digits), "\u202f%" if value is not None and math.isfinite(value) else "")


def card(value: str | Markup, what: str, more: str = "") -> Markup:
    """A result worth a glance."""
    return element("div", element("b", value), what, element("small", more) if more else None, class_="card")
