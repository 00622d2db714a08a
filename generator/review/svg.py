"""Numbers and text of SVG pictures, the same to the byte on every machine."""

from __future__ import annotations

from collections.abc import Iterable

from generator.review.formula import GREEK, Name
from generator.review.markup import Content, Markup, element

#: Moves values that lie on a rounding boundary by symmetry off it, whatever the last bit of a sine is.
_OFF_THE_BOUNDARY = 3.1e-5


def pixel(value: float) -> str:
    """A coordinate to a tenth of a pixel."""
    text = f"{value + _OFF_THE_BOUNDARY:.1f}".removesuffix(".0")
    return "0" if text == "-0" else text


def points(outline: Iterable[tuple[float, float]]) -> str:
    """Coordinates as ``polyline`` and ``path`` read them."""
    return " ".join(f"{pixel(x)},{pixel(y)}" for x, y in outline)


def svg(width: float, height: float, title: str, description: str, *content: Content, kind: str = "") -> Markup:
    """A picture that scales with its column and tells screen readers what it shows."""
    return element(
        "svg",
        element("title", title),
        element("desc", description),
        "\n",
        *content,
        xmlns="http://www.w3.org/2000/svg",
        viewbox=f"0 0 {pixel(width)} {pixel(height)}",
        width=pixel(width),
        height=pixel(height),
        role="img",
        class_=kind or None,
    )


def text(x: float, y: float, *content: Content, kind: str, anchor: str = "middle", **attributes: object) -> Markup:
    """Text whose anchor lies at (x, y), y the baseline."""
    return element("text", *content, x=pixel(x), y=pixel(y), class_=kind, text_anchor=anchor, **attributes)


def subscripted(names: Iterable[Name]) -> list[Content]:
    """Names with their subscripts lowered, for use inside ``text``."""
    content: list[Content] = []
    for index, name in enumerate(names):
        stem, below = name.parts
        if index:
            content.append(", ")
        content.append(element("tspan", GREEK.get(stem, stem), class_="variable"))
        if below:
            content += [element("tspan", below, dy="0.3em", class_="below"), element("tspan", "\u200b", dy="-0.3em")]
    return content
