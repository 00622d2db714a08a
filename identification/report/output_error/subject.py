"""What the sections of a report on output error are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from generator.quantities import signals
from identification.output_error.multi_start import OutputError


@dataclass(frozen=True)
class Subject:
    """Output error, and ``results`` as in results.json."""

    found: OutputError
    results: Mapping[str, Any]

    @property
    def position_units(self) -> dict[int, str]:
        """By the joint's number."""
        numbers = [joint.number for joint in self.found.robot.moving]
        return dict(zip(numbers, signals.position_units(self.found.first.regressors.model), strict=True))

    @property
    def torque_units(self) -> tuple[str, ...]:
        """In the joints' order."""
        return tuple(signals.torque_units(self.found.first.regressors.model))
