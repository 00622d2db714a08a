"""The review: groupings as text and LaTeX, and one page that shows the whole model to a reader."""

from __future__ import annotations

import generator.review.sections
from generator.backends.printing.templates import render
from generator.review import documents
from generator.review.markup import Markup, element
from generator.review.page import sections
from generator.symbolic.model import Model
from generator.version import VERSION

NAME = "review"


def groupings(model: Model) -> str:
    """The text of ``groupings.md``."""
    return render("review/groupings.md.jinja", document=documents.markdown(model))


def emit(model: Model) -> dict[str, str | bytes]:
    """The files of the review by their paths: ``groupings.md``, ``groupings.tex``, ``review.html``."""
    robot = model.robot
    page = {
        "title": element("title", f"{robot.name}: model review"),
        "heading": element("h1", robot.name),
        "description": element("p", robot.description, class_="lead") if robot.description else Markup(""),
        "sections": sections(generator.review.sections, model),
        "style": Markup(render("review/style.css")),
        "digest": robot.digest,
        "version": VERSION,
    }
    return {
        "groupings.md": groupings(model),
        "groupings.tex": render("review/groupings.tex.jinja", document=documents.tex(model, documents.markdown(model))),
        "review.html": render("review/page.html.jinja", **page),
    }
