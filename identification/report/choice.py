"""One of several panels at a time; equal choices all over the page change together."""

from __future__ import annotations

from collections.abc import Mapping

from generator.review.markup import Content, Markup, element, join

#: Options that stand side by side; more become a menu.
_SIDE_BY_SIDE = 8


def choice(group: str, label: str, options: Mapping[str, Content], chosen: str | None = None) -> Markup:
    """Panels by the text on their buttons, the one ``chosen`` shown, else the first.

    Choices of one ``group`` follow each other where they have the option. A single panel stands without buttons.
    """
    if len(options) == 1:
        return join(*options.values())
    shown = chosen if chosen in options else next(iter(options))
    if len(options) <= _SIDE_BY_SIDE:
        offered: Content = [
            element("button", name, type="button", value=name, aria_pressed=str(name == shown).lower())
            for name in options
        ]
    else:
        offered = element("select", [_option(name, name == shown) for name in options], aria_label=label)
    panels = [
        element(
            "div", element("p", f"{label} {name}", class_="chosen"), panel,
            data_value=name, hidden=None if name == shown else "hidden",
        )
        for name, panel in options.items()
    ]  # fmt: skip
    bar = element("div", element("span", label), offered, class_="options", role="group", aria_label=label)
    return element("div", bar, "\n", panels, class_="choice", data_group=group)


def _option(name: str, selected: bool) -> Markup:
    return element("option", name, value=name, selected="selected" if selected else None)
