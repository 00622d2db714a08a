"""Shares with their uncertainty."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

#: Of the normal distribution, 95 % two-sided.
_Z = 1.959963984540054


@dataclass(frozen=True)
class Share:
    """``hits`` of ``count``."""

    hits: int
    count: int

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's 95 % interval of the share (Wilson 1927); all of 0 to 1 without a count."""
        if not self.count:
            return 0.0, 1.0
        n, p, z2 = self.count, self.hits / self.count, _Z**2
        middle = (p + z2 / (2 * n)) / (1 + z2 / n)
        half = _Z * sqrt(p * (1 - p) / n + z2 / (4 * n * n)) / (1 + z2 / n)
        return max(middle - half, 0.0), min(middle + half, 1.0)

    def __str__(self) -> str:
        """Such as 57/60 = 95 % (86 to 98)."""
        if not self.count:
            return "no case"
        low, high = self.interval
        return f"{self.hits}/{self.count} = {100 * self.hits / self.count:.0f} % ({100 * low:.0f} to {100 * high:.0f})"


def share(flags: list[bool]) -> Share:
    """Of the flags that are true."""
    return Share(sum(flags), len(flags))
