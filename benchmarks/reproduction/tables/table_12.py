"""Table 12: what the parameters leave of the torques of the KR500-2MT."""

from __future__ import annotations

from benchmarks.reproduction.results import Results
from benchmarks.reproduction.rows import Row, residual_rows

TITLE = "Table 12: KR500-2MT, unexplained part of the torques"


def rows(results: Results) -> list[Row]:
    """A row an axis."""
    return residual_rows(results.residuals("idim_ls", "full"), "table_12")
