"""What the sections of a report on drive gains are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from identification.drive_gains import DriveGains
from identification.gains_results import gains, parameters


@dataclass(frozen=True)
class Subject:
    """Drive gains, and ``results`` as in results.json."""

    found: DriveGains
    results: Mapping[str, Any]

    @property
    def gains(self) -> dict[str, Any]:
        """Those of the parameters in ``results`` that are g_tau or kt, by name."""
        return {name: self.results["parameters"][name] for name in gains(self.found)}

    @property
    def parameters(self) -> dict[str, Any]:
        """The others, by name."""
        return {name: self.results["parameters"][name] for name in parameters(self.found)}
