"""What the sections of a report on output error are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from generator.quantities import signals
from identification.arrays import Array
from identification.output_error.experiment import Experiment
from identification.output_error.multi_start import OutputError


@dataclass(frozen=True)
class ShownRun:
    """A run that was simulated; ``errors`` are measured less simulated positions (S x K x n) [rad, m]."""

    name: str
    experiment: Experiment
    errors: Array


@dataclass(frozen=True)
class Subject:
    """Output error, and ``results`` as in results.json."""

    found: OutputError
    results: Mapping[str, Any]

    @property
    def runs(self) -> tuple[ShownRun, ...]:
        """The fitted ones, then those held out."""
        found, best = self.found, self.found.best
        fitted = zip(found.train, best.errors, strict=True)
        held_out = zip(found.test, best.test_errors, strict=True)
        return (
            *(ShownRun(one.run.name, one, errors) for one, errors in fitted),
            *(ShownRun(f"{one.run.name} (held out)", one, errors) for one, errors in held_out),
        )

    @property
    def position_units(self) -> dict[int, str]:
        """By the joint's number."""
        numbers = self.found.robot.numbers
        return dict(zip(numbers, signals.position_units(self.found.first.regressors.model), strict=True))

    @property
    def torque_units(self) -> tuple[str, ...]:
        """In the joints' order."""
        return tuple(signals.torque_units(self.found.first.regressors.model))
