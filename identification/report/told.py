"""What a result remarks on itself."""

from __future__ import annotations

from collections.abc import Sequence

from generator.review.markup import Markup, element, join


def notes(texts: Sequence[str]) -> Markup | None:
    """Repairs and doubts, as results.json has them; None without any."""
    if not texts:
        return None
    listing = element("ul", [element("li", one) for one in texts], class_="notes")
    return join(element("h3", "Repairs and doubts"), listing)


def facts(values: dict[str, str]) -> Markup:
    """Names with what is said of them."""
    return element(
        "dl", [element("div", element("dt", k), element("dd", v)) for k, v in values.items()], class_="facts"
    )
