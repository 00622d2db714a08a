"""Table 8: what the parameters leave of the torques of the KR270-2F."""

from __future__ import annotations

from benchmarks.reproduction.results import Results
from benchmarks.reproduction.rows import Row, residual_rows

TITLE = "Table 8: KR270-2F, unexplained part of the torques"


def rows(results: Results) -> list[Row]:
    """A row an axis."""
    return residual_rows(results.residuals("gains", "gains"), "table_8")
