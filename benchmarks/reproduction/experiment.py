"""What an experiment finds with one draw of its noise, beside what is true."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Protocol

from generator.robot.description import Robot
from identification.simulation.run_file import save
from identification.simulation.simulate import Simulated

#: Standard deviations within which a value counts as inside.
INSIDE = 2.0


@dataclass(frozen=True)
class Estimate:
    """A parameter [``unit``]: what it is in the twin, and what was found with which standard deviation."""

    name: str
    unit: str
    true: float
    value: float
    std: float

    @property
    def deviations(self) -> float:
        """(value - true) in standard deviations."""
        return (self.value - self.true) / self.std

    @property
    def inside(self) -> bool:
        """Whether the true value is within ``INSIDE`` standard deviations."""
        return abs(self.deviations) <= INSIDE


@dataclass(frozen=True)
class Found:
    """Estimates by model, such as ``full``; ||e||/||Y - mean(Y)|| of each axis in % by model."""

    models: Mapping[str, tuple[Estimate, ...]]
    residuals: Mapping[str, tuple[float, ...]] = field(default_factory=dict)

    def as_json(self) -> dict[str, Any]:
        """For the results file."""
        return asdict(self)


class Experiment(Protocol):
    """A module of ``benchmarks/reproduction/experiments/``."""

    TITLE: str
    COVERING: Sequence[str]

    def play(self, seeds: Sequence[int], folder: Path) -> Iterator[Found]:
        """What is found for each seed of the noise; files go to ``folder``."""


def saved(run: Simulated, robot: Robot, path: Path) -> str:
    """The run as a file, as ``counterpoise simulate`` writes it; returns its path."""
    return str(save(run, robot.name, robot.digest, path)[0])
