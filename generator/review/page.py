"""The review page put together: every section that the robot has, in order."""

from __future__ import annotations

from dataclasses import dataclass

import generator.review.sections
from generator.discovery import modules
from generator.review.markup import Markup
from generator.symbolic.model import Model


@dataclass(frozen=True)
class Section:
    """A section of the page: its anchor, heading and body."""

    anchor: str
    title: str
    body: Markup


def sections(model: Model) -> list[Section]:
    """The sections found in ``generator.review.sections`` that apply to a model, in their order."""
    found = sorted(modules(generator.review.sections), key=lambda module: (module.ORDER, module.__name__))
    rendered = ((module, module.render(model)) for module in found)
    return [
        Section(module.__name__.rsplit(".", 1)[1].replace("_", "-"), module.TITLE, body)
        for module, body in rendered
        if body is not None
    ]
