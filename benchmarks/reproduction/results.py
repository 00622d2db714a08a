"""Results of ``make reproduce`` as they are kept: ``benchmarks/reproduction.json``."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.reproduction.experiment import Estimate

FILE = Path(__file__).parents[1] / "reproduction.json"


@dataclass(frozen=True)
class Results:
    """What the experiments found, by their names."""

    experiments: Mapping[str, Any]

    def estimates(self, experiment: str, model: str) -> dict[str, Estimate]:
        """By name, those with the first draw of the noise."""
        found = self.experiments[experiment]["first"]["models"][model]
        return {one["name"]: Estimate(**one) for one in found}

    def residuals(self, experiment: str, model: str) -> list[float]:
        """Of each axis [%], with the first draw of the noise."""
        residuals: list[float] = self.experiments[experiment]["first"]["residuals"][model]
        return residuals

    def coverage(self, experiment: str, model: str) -> Mapping[str, Any]:
        """See ``coverage``."""
        found: Mapping[str, Any] = self.experiments[experiment]["coverage"][model]
        return found


def read() -> Results:
    """The results that are there."""
    return Results(json.loads(FILE.read_text(encoding="utf-8")))


def write(results: Results) -> None:
    """Keeps the results."""
    text = json.dumps(results.experiments, indent=1, ensure_ascii=False)
    FILE.write_text(text + "\n", encoding="utf-8")
