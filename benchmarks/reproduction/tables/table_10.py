"""Table 10: stiffness of axis 2 of the KR270-2F, output blocked."""

from __future__ import annotations

from benchmarks.reproduction.results import Results
from benchmarks.reproduction.rows import Row, parameter_rows, printed_set

TITLE = "Table 10: KR270-2F, stiffness of axis 2 with a blocked output"


def rows(results: Results) -> list[Row]:
    """The essential parameters of eq. 70."""
    return parameter_rows(results.estimates("locked_output", "k2"), printed_set("kr270", "report_table_10"))
