"""The templates of the output languages."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import jinja2

from generator import resources


def render(name: str, **context: object) -> str:
    """The text of template ``name`` (``c/header.h.jinja``); a variable that the context lacks is an error."""
    return _environment(resources.templates()).get_template(name).render(context)


@cache
def _environment(folder: Path) -> jinja2.Environment:
    """Compiles a template once."""
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
