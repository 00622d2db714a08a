"""The templates of the output languages."""

from __future__ import annotations

import jinja2

from generator import resources


def render(name: str, **context: object) -> str:
    """The text of template ``name`` (``c/header.h.jinja``); a variable that the context lacks is an error."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(resources.templates()),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
    return environment.get_template(name).render(context)
