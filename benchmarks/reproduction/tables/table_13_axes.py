"""Below Table 13: what the simulation leaves of the positions of the KR500-2MT."""

from __future__ import annotations

from benchmarks.reproduction.results import Results
from benchmarks.reproduction.rows import Row, residual_rows

TITLE = "Below Table 13: KR500-2MT, unexplained part of the positions"


def rows(results: Results) -> list[Row]:
    """A row an axis."""
    return residual_rows(results.residuals("output_error", "full"), "table_13")
