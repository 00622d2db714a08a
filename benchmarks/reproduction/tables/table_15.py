"""Table 15: stiffness of axes 1 to 3 of the KR500-2MT by steps of force."""

from __future__ import annotations

from benchmarks.reproduction.results import Results
from benchmarks.reproduction.rows import Row, parameter_rows, printed_set

TITLE = "Table 15: KR500-2MT, stiffness by steps of force"


def rows(results: Results) -> list[Row]:
    """With the whole wrench, and beside it what fz alone gives."""
    printed = printed_set("kr500", "report_table_15")
    alone = results.estimates("force_steps", "stiffness, fz alone")
    rows = parameter_rows(results.estimates("force_steps", "stiffness"), printed)
    return [{**row, "fz alone": f"{alone[str(row['parameter'])].value:.4g}"} for row in rows]
