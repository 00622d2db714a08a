"""What the runs that nobody touched say of the old and the new model, and how far both are from the noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from identification.diagnosis.bank import Bank
from identification.diagnosis.noise_floor import noise_floor
from identification.diagnosis.played import Played

#: Least gap to the noise, in squares of the residual, of which a share is told.
_GAP = 0.25


@dataclass(frozen=True)
class Untouched:
    """A joint of the untouched runs: rms of the residual before, after, and of noise; spread of its torque [N m, N]."""

    before: float
    after: float
    floor: float
    spread: float

    @property
    def relative_before(self) -> float:
        """In % of the torque's spread."""
        return 100 * self.before / self.spread

    @property
    def relative_after(self) -> float:
        """In % of the torque's spread."""
        return 100 * self.after / self.spread

    @property
    def relative_floor(self) -> float:
        """In % of the torque's spread."""
        return 100 * self.floor / self.spread

    @property
    def closed(self) -> float | None:
        """The share of the gap between ``before`` and the noise that is closed, in squares; None without a gap."""
        gap = self.before**2 - self.floor**2
        return (self.before**2 - self.after**2) / gap if gap > _GAP * self.before**2 else None


def untouched(bank: Bank, before: Sequence[Played], after: Sequence[Played]) -> dict[int, Untouched]:
    """By the joint's number, all runs together, on rows that both models' plays have; joints without rows are left out.

    The noise is that of the runs in ``bank``, at the rate of these rows.
    """
    result: dict[int, Untouched] = {}
    for k, joint in enumerate(bank.scenes[0].robot.moving):
        pairs = list(zip(before, after, strict=True))
        kept = [one.kept[k] & other.kept[k] for one, other in pairs]
        if not any(rows.any() for rows in kept):
            continue
        torque, old, new = (
            np.concatenate([signal[k, rows] for signal, rows in zip(signals, kept, strict=True)])
            for signals in (
                [one.measured for one, _ in pairs],
                [one.measured - one.model for one, _ in pairs],
                [other.measured - other.model for _, other in pairs],
            )
        )
        first, last = (float(np.sqrt(np.mean(e**2))) for e in (old, new))
        rate = 1 / float(np.median(np.diff(before[0].t)))
        result[joint.number] = Untouched(first, last, noise_floor(bank, k, rate), float(torque.std()) or np.inf)
    return result
