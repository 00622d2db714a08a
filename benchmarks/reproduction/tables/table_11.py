"""Table 11: parameters of the KR500-2MT by the inverse model and least squares."""

from __future__ import annotations

from benchmarks.reproduction.experiment import Estimate
from benchmarks.reproduction.results import Results
from benchmarks.reproduction.rows import Row, parameter_rows, printed_set

TITLE = "Table 11: KR500-2MT, parameters by inverse model and least squares"


def rows(results: Results) -> list[Row]:
    """All base parameters, with what the essential model has for them."""
    essential = results.estimates("idim_ls", "essential")
    full = parameter_rows(results.estimates("idim_ls", "full"), printed_set("kr500", "report_table_11"))
    return [{**row, "essential model": _essential(str(row["parameter"]), essential)} for row in full]


def _essential(name: str, essential: dict[str, Estimate]) -> str | None:
    return f"{essential[name].value:.4g}" if name in essential else None
