"""docs/reproduction.md: its tables between pairs of comments, from the results that are kept. Nothing here measures.

``python -m benchmarks.reproduction.page`` writes it anew.
"""

from __future__ import annotations

from pathlib import Path

import benchmarks.reproduction.experiments
import benchmarks.reproduction.tables
from benchmarks.documents import ROOT, replaced
from benchmarks.reproduction.coverage import share, worst
from benchmarks.reproduction.results import Results, read
from benchmarks.reproduction.rows import Row
from benchmarks.table import table
from generator.discovery import modules

PAGE = ROOT / "docs" / "reproduction.md"
#: How many of the parameters that an essential model falsifies most are listed.
_LISTED = 12


def page(results: Results) -> str:
    """The page as the results have it; the text between the tables stays."""
    text = PAGE.read_text(encoding="utf-8")
    for module in modules(benchmarks.reproduction.tables):
        name = module.__name__.rpartition(".")[2].replace("_", " ")
        text = replaced(text, name, f"**{module.TITLE}**\n\n{table(module.rows(results))}")
    text = replaced(text, "coverage", table(coverage_rows(results)))
    return replaced(text, "essential", table(essential_rows(results)))


def coverage_rows(results: Results) -> list[Row]:
    """A row a model of each experiment."""
    rows: list[Row] = []
    for module in modules(benchmarks.reproduction.experiments):
        name = module.__name__.rpartition(".")[2]
        for model in module.COVERING:
            counted = results.coverage(name, model)
            least = worst(counted)
            rows.append(
                {
                    "experiment": module.TITLE,
                    "model": model,
                    "draws": results.experiments[name]["draws"],
                    "estimates": counted["count"],
                    "inside [%]": f"{share(counted):.1f}",
                    "least": least,
                    "inside, least [%]": f"{share(counted['parameters'][least]):.0f}",
                }
            )
    return rows


def essential_rows(results: Results) -> list[Row]:
    """The parameters that the essential model of IDIM-LS falsifies most."""
    counted = results.coverage("idim_ls", "essential")["parameters"]
    most = max(one["count"] for one in counted.values())
    names = [name for name, one in counted.items() if one["count"] > most / 2]
    names.sort(key=lambda name: -abs(counted[name]["bias"]))
    return [
        {
            "parameter": name,
            "kept in [%]": f"{100 * counted[name]['count'] / most:.0f}",
            "bias [std]": f"{counted[name]['bias']:+.1f}",
            "inside [%]": f"{share(counted[name]):.0f}",
        }
        for name in names[:_LISTED]
    ]


def write(results: Results, path: Path = PAGE) -> None:
    """Writes the page."""
    path.write_text(page(results), encoding="utf-8")


if __name__ == "__main__":
    write(read())
