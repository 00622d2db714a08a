"""What the sections of a diagnosis' report are made of."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from generator.quantities import signals
from identification.diagnosis.diagnosis import Diagnosis
from identification.diagnosis.mending import Mended
from identification.diagnosis.noise_floor import noise_floor
from identification.diagnosis.played import Played

Array = NDArray[np.float64]

#: Least gap to the noise, in squares of the residual, of which a share is told.
_GAP = 0.25


@dataclass(frozen=True)
class Tried:
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
        """The share of the gap between ``before`` and the noise that is closed; None where there is no gap."""
        gap = self.before**2 - self.floor**2
        return (self.before**2 - self.after**2) / gap if gap > _GAP * self.before**2 else None


@dataclass(frozen=True)
class Subject:
    """A diagnosis, and the mended robot with the untouched runs played through it, None after a dry run."""

    found: Diagnosis
    mended: Mended | None = None

    @property
    def numbers(self) -> list[int]:
        """The joints' numbers."""
        return [joint.number for joint in self.found.robot.moving]

    @property
    def leading(self) -> str:
        """The joint that is looked at first, as it is named on buttons."""
        return str(self.found.before.joint or self.numbers[0])

    @cached_property
    def torque_units(self) -> dict[int, str]:
        """By the joint's number."""
        model = self.found.found.bank.scenes[0].regressors.model
        return dict(zip(self.numbers, signals.torque_units(model), strict=True))

    @property
    def tested(self) -> list[tuple[str, Played, Played]]:
        """Untouched runs by name, as the model before and the one after play them."""
        if self.mended is None:
            return []
        names = [Path(one).name for one in self.found.roles.test]
        return list(zip(names, self.mended.before, self.mended.after, strict=True))

    @cached_property
    def tried(self) -> dict[int, Tried]:
        """Untouched runs together, by the joint's number; joints without rows are not there."""
        result = {}
        for k, number in enumerate(self.numbers):
            parts = [(one, other, one.kept[k] & other.kept[k]) for _, one, other in self.tested]
            y = np.concatenate([one.measured[k, rows] for one, _, rows in parts] or [np.empty(0)])
            if not len(y):
                continue
            before, after = (
                np.concatenate([(pair[i].measured - pair[i].model)[k, pair[2]] for pair in parts]) for i in (0, 1)
            )
            floor = noise_floor(self.found.found.bank, k, self._rate)
            first, last = (float(np.sqrt(np.mean(e**2))) for e in (before, after))
            result[number] = Tried(first, last, floor, float(y.std()) or np.inf)
        return result

    @property
    def _rate(self) -> float:
        """Rows a second of the untouched runs [Hz]."""
        one = self.tested[0][1]
        return 1 / float(np.median(np.diff(one.t)))
