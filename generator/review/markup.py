"""Markup that is well-formed by construction: text is escaped unless it is markup already."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from typing import TypeAlias


class Markup(str):
    """Text that is markup already and is not escaped again."""

    __slots__ = ()

    def __html__(self) -> str:
        """What template engines ask for before they escape."""
        return str(self)


Content: TypeAlias = "str | int | Iterable[Content] | None"


def element(tag: str, *content: Content, **attributes: object) -> Markup:
    """An element, valid as HTML and as XML.

    Keyword names lose a trailing underscore and keep dashes for inner ones (``stroke_width`` is ``stroke-width``);
    attributes that are None are left out, lists of content are flattened, None in content is nothing.
    """
    opening = tag + "".join(
        f' {_attribute_name(name)}="{escape(str(value))}"' for name, value in attributes.items() if value is not None
    )
    inside = join(*content)
    return Markup(f"<{opening}>{inside}</{tag}>" if inside or tag not in _VOID else f"<{opening} />")


def join(*content: Content, by: str = "") -> Markup:
    """Contents one after the other, text escaped."""
    return Markup(by.join(_flatten(content)))


def table(heads: Iterable[Content], rows: Iterable[Iterable[Content]], **attributes: object) -> Markup:
    """A table in a box that scrolls sideways when the screen is narrow; the first cell of a row is its header."""
    head = element("thead", element("tr", [element("th", cell, scope="col") for cell in heads]))
    body = []
    for row in rows:
        first, *rest = row
        body.append(element("tr", element("th", first, scope="row"), [element("td", cell) for cell in rest], "\n"))
    return element("div", element("table", head, element("tbody", body), **attributes), class_="wide")


#: Elements that HTML writes without content; SVG's shapes close themselves as well.
_VOID = {"br", "hr", "img", "input", "meta", "line", "path", "rect", "circle", "ellipse", "polygon", "polyline", "use"}

#: SVG attributes in camel case.
_CAMEL = {"viewbox": "viewBox", "gradientunits": "gradientUnits", "preserveaspectratio": "preserveAspectRatio"}


def _attribute_name(name: str) -> str:
    name = name.rstrip("_")
    return _CAMEL.get(name, name.replace("_", "-"))


def _flatten(content: Iterable[Content]) -> Iterable[str]:
    for item in content:
        if isinstance(item, Markup):
            yield item
        elif isinstance(item, str):
            yield escape(item, quote=False)
        elif isinstance(item, int):
            yield str(item)
        elif item is not None:
            yield from _flatten(item)
