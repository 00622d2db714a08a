"""What a study is, and running one by itself."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from benchmarks.compiling import Missing
from benchmarks.table import table

#: Where studies build; what one run compiled, the next one need not.
BUILD = Path(__file__).parents[1] / "build" / "bench"
#: Stands in the cells of a row whose results disagree.
VOID = "void"

Result = Mapping[str, Any]


class Study(Protocol):
    """A module of ``benchmarks/studies/``."""

    TITLE: str

    def run(self, build: Path) -> Mapping[str, object]:
        """``{"rows": [{column: value}], "notes": [str]}``; raises Missing where the machine lacks a tool."""


def measured(name: str, study: Study) -> dict[str, Any]:
    """The result of a study for JSON: its title, rows and notes. One that cannot be run has a note that says why."""
    result: Mapping[str, Any]
    try:
        folder = BUILD / name
        folder.mkdir(parents=True, exist_ok=True)
        result = study.run(folder)
    except Missing as missing:
        result = {"notes": [f"not measured: {missing} is missing"]}
    except Exception as error:
        print(f"error: study {name}: {error}", file=sys.stderr)
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        result = {"notes": [f"not measured: {reason}"], "failed": True}
    return {"title": study.TITLE, "rows": [], "notes": [], **result}


def status(results: Sequence[Result]) -> int:
    """The exit status: 1 if a row is void or a study broke down, else 0."""
    void = any(VOID in row.values() for result in results for row in result["rows"])
    return int(void or any(result.get("failed") for result in results))


def shown(result: Result) -> str:
    """A study's table and notes in Markdown."""
    notes = "\n".join(f"- {note}" for note in result["notes"])
    return "\n\n".join(part for part in (table(result["rows"]), notes) if part)


def alone(file: str, study: Any) -> None:
    """Runs one study, prints what it found, and leaves with its status; for ``if __name__ == "__main__"``."""
    result = measured(Path(file).stem, study)
    print(f"{result['title']}\n\n{shown(result)}")
    sys.exit(status([result]))
