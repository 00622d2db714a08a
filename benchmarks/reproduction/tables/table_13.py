"""Table 13: parameters of the KR500-2MT by output error."""

from __future__ import annotations

from benchmarks.reproduction.results import Results
from benchmarks.reproduction.rows import Row, parameter_rows, printed_set

TITLE = "Table 13: KR500-2MT, parameters by output error"


def rows(results: Results) -> list[Row]:
    """All base parameters."""
    return parameter_rows(results.estimates("output_error", "full"), printed_set("kr500", "report_table_13"))
