"""A report as one file that fetches nothing: its sections, the style sheet and the script of the charts."""

from __future__ import annotations

from types import ModuleType

from plotly.offline import get_plotlyjs

from generator.backends.printing.templates import render
from generator.review.markup import Markup, element
from generator.review.page import sections
from generator.version import VERSION

#: Name of the file, beside results.json or diagnosis.json.
REPORT = "report.html"


def page(title: str, lead: str, package: ModuleType, subject: object, of: str, digest: str) -> bytes:
    """The HTML of a report on ``subject``, in UTF-8; the same bytes for the same subject.

    Its sections are the modules of ``package``, each with ``TITLE``, ``ORDER`` and ``render(subject)``, which returns
    None where the section does not apply. ``of`` and ``digest`` say what the report is about: a file, its SHA-256.
    """
    text = render(
        "report/page.html.jinja",
        title=element("title", title),
        heading=element("h1", title),
        description=element("p", lead, class_="lead"),
        sections=sections(package, subject),
        style=Markup(render("review/style.css") + render("report/style.css")),
        subject=of,
        digest=digest,
        version=VERSION,
        plotly=get_plotlyjs(),
        charts=render("report/charts.js"),
    )
    return text.encode()
