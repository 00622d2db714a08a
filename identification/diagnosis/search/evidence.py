"""What speaks for a hypothesis with one shape beside others that were chosen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import hypot

from identification.arrays import Array
from identification.diagnosis.columns.bank import Variant


@dataclass(frozen=True)
class Evidence:
    """What a variant explains beside the chosen ones: drop of the sum of squares, its p-value, BIC, validation.

    ``sizes`` are the rms beside the noise's, by the coordinate on which it acts; what is not ``believed`` is as large
    as a free fit makes it of other things, and what is ``small`` would be taken were rows not few.
    """

    variant: Variant
    coefficients: Array
    drop: float
    p: float
    bic: float
    validation: float
    sizes: Mapping[int, float]
    passes: bool
    why_not: str = ""
    believed: bool = True
    small: bool = False

    @property
    def score(self) -> float:
        """Rank: information criterion and held-out drop together."""
        return self.bic + self.validation

    @property
    def place(self) -> int:
        """The coordinate on which it is the largest."""
        return max(self.sizes, key=lambda k: self.sizes[k])

    @property
    def size(self) -> float:
        """Rms beside the noise's on that coordinate."""
        return self.sizes[self.place]

    @property
    def whole(self) -> float:
        """The sizes on all coordinates, added by their squares."""
        return hypot(*self.sizes.values())
