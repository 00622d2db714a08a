"""Rows of a regression that need no robot."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from types import SimpleNamespace

from identification.sampling import Rows


@dataclass(frozen=True)
class Told:
    """A run's ``parts``; it is one of so many ``samples`` at 1 kHz where that is asked for."""

    parts: tuple[Rows, ...]
    samples: int = 0

    @property
    def sampled(self) -> SimpleNamespace:
        return SimpleNamespace(
            run=SimpleNamespace(period=1e-3, start=0.0), motion=SimpleNamespace(samples=self.samples)
        )

    def rows(self) -> Iterator[Rows]:
        return iter(self.parts)
