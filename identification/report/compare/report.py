"""The report of a comparison, as one call."""

from __future__ import annotations

from identification.comparison import Comparison
from identification.report.compare import sections
from identification.report.page import page


def report(found: Comparison) -> bytes:
    """The page on ``found``."""
    a, b = found.a, found.b
    return page(f"{b.name} compared with {a.name}", "Parameter by parameter", sections, found, a.file, a.sha256)
