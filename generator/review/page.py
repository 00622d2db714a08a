"""A page put together from the sections in a folder: all that apply to its subject, in order."""

from __future__ import annotations

from dataclasses import dataclass
from types import ModuleType

from generator.discovery import modules
from generator.review.markup import Markup


@dataclass(frozen=True)
class Section:
    """A section of the page: its anchor, heading and body."""

    anchor: str
    title: str
    body: Markup


def sections(package: ModuleType, subject: object) -> list[Section]:
    """What the modules of ``package`` render of a subject, by their ``ORDER``; one that renders None is left out."""
    found = sorted(modules(package), key=lambda module: (module.ORDER, module.__name__))
    rendered = ((module, module.render(subject)) for module in found)
    return [
        Section(module.__name__.rsplit(".", 1)[1].replace("_", "-"), module.TITLE, body)
        for module, body in rendered
        if body is not None
    ]
