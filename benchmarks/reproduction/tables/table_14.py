"""Table 14: output error compared with the inverse model, eq. 79."""

from __future__ import annotations

from collections.abc import Mapping

from benchmarks.reproduction.experiment import Estimate
from benchmarks.reproduction.results import Results
from benchmarks.reproduction.rows import Row, printed_numbers
from identification.comparison import Difference, compare
from identification.parameter_source import Known, Parameters, parameters

TITLE = "Table 14: KR500-2MT, differences between the two methods"


def rows(results: Results) -> list[Row]:
    """A row a parameter that is printed: eq. 79 as printed, recomputed from Tables 11 and 13, and on the twin."""
    printed = printed_numbers("table_14")
    recomputed = compare(parameters("kr500:report_table_11"), parameters("kr500:report_table_13")).differences
    inverse, output = (_named(results.estimates(name, "full"), name) for name in ("idim_ls", "output_error"))
    ours = compare(inverse, output).differences
    return [
        {
            "parameter": name,
            "printed [%]": f"{value:.4g}",
            "recomputed [%]": _percent(recomputed[name]),
            "ours [%]": _percent(ours[name]),
            "ours [std]": f"{ours[name].deviations:.1f}",
            "within 2 std": "yes" if ours[name].agrees else "**no**",
        }
        for name, value in printed.items()
    ]


def _named(estimates: Mapping[str, Estimate], name: str) -> Parameters:
    values = {one.name: Known(one.value, one.std, one.unit) for one in estimates.values()}
    return Parameters(name, name, "", values)


def _percent(one: Difference) -> str:
    return f"{one.percent:.1f}"
