"""Results in the documents: tables between pairs of comments, and the pictures. Nothing here measures.

``python -m benchmarks.documents`` writes them anew from ``benchmarks/results.json``.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from benchmarks.chart import chart
from benchmarks.growth_picture import growth
from benchmarks.study import shown
from benchmarks.summary import bars, summary
from benchmarks.table import table

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "benchmarks" / "results.json"
README, PERFORMANCE = Path("README.md"), Path("docs/performance.md")
PICTURE, GROWTH = Path("docs/images/performance.svg"), Path("docs/images/growth.svg")

Results = Mapping[str, Any]


def documented(results: Results) -> dict[Path, str]:
    """The documents and the pictures as the results have them, by their paths in the repository."""
    files = {PERFORMANCE: replaced(_read(PERFORMANCE), "machine", table(_facts(results["machine"])))}
    for name, result in results["studies"].items():
        page = _page(name)
        text = files[page] if page in files else _read(page)
        files[page] = replaced(_with_section(text, name, result["title"]), f"study {name}", shown(result))
    if rows := results["studies"].get("peers", {}).get("rows"):
        files[README] = replaced(_read(README), "performance", table(summary(rows)))
        files[PICTURE] = chart(f"Time of one call, {rows[0]['robot']}", bars(rows), "the generated C")
    if rows := results["studies"].get("growth", {}).get("rows"):
        files[GROWTH] = growth(rows)
    return files


def _facts(machine: Mapping[str, str]) -> list[dict[str, object]]:
    return [{"": name, "measured on": value} for name, value in machine.items()]


def _page(name: str) -> Path:
    """The document that has a place for a study's results; the page on performance for one that has none."""
    pages = sorted(path.relative_to(ROOT) for path in (ROOT / "docs").glob("*.md"))
    return next((page for page in pages if f"<!-- study {name} -->" in _read(page)), PERFORMANCE)


def _read(path: Path) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


def _with_section(text: str, name: str, title: str) -> str:
    """The page with a section for a study that has none yet, behind the others."""
    if f"<!-- study {name} -->" in text:
        return text
    return f"{text.rstrip()}\n\n## {title}\n\n<!-- study {name} -->\n<!-- end of study {name} -->\n"


def replaced(text: str, name: str, content: str) -> str:
    """``text`` with ``content`` between the comments of ``name``, which must stand in it once."""
    begin, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
    before, found, rest = text.partition(begin)
    _, closed, after = rest.partition(end)
    if not (found and closed) or begin in rest:
        raise ValueError(f"no pair of comments {begin.strip()} {end}")
    return f"{before}{begin}\n{content}\n\n{end}{after}"


def main() -> None:
    """Writes the documents anew from the results that are there."""
    for path, text in documented(json.loads(RESULTS.read_text(encoding="utf-8"))).items():
        (ROOT / path).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
