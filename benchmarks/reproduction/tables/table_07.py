"""Table 7: drive gains and parameters of the KR270-2F."""

from __future__ import annotations

from benchmarks.reproduction.results import Results
from benchmarks.reproduction.rows import Row, parameter_rows, printed_set

TITLE = "Table 7: KR270-2F, drive gains and parameters"


def rows(results: Results) -> list[Row]:
    """Gains, then all base parameters, then the payload."""
    found = {**results.estimates("gains", "gains"), **results.estimates("gains", "parameters")}
    return parameter_rows(found, printed_set("kr270", "report_table_7"))
