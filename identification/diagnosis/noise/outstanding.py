"""What stands out of a joint: effects of which one alone explains much of what the model leaves there.

Where rows are too few for all that may act to be taken away, noise would hold a part of whatever the model lacks. What
explains so much by itself is no noise: chance is told by the rows that are as good as independent beside it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from identification.arrays import Array
from identification.colour import inflation
from identification.diagnosis.columns.bank import Bank, Variant
from identification.diagnosis.columns.normal_equations import Places
from identification.diagnosis.noise.may_act import Rows, allowed

#: Least size of what stands out, in parts of the rms that is left beside it: a robot's own laws are unlike by a fifth.
#: Its chance over everything tried.
_LEAST, _ALPHA = 5.0, 1e-3
#: Effects that are taken away at most, and how many that explain most are looked at each time.
_MOST, _JUDGED = 3, 8
#: Part of the largest singular value, and of a column's square, that must be left; part of a power that is rounding.
_RANK, _LEFT, _ROUNDING = 1e-5, 1e-3, 1e-12


def outstanding(parts: Sequence[Rows], bank: Bank, joint: int) -> list[int]:
    """Numbers of the columns of such effects on a joint whose rows in each run are ``parts``; none where there are rows
    enough for all columns. What is numbered below the bank's candidates is known to act.
    """
    every = _Rows.of(parts)
    known = [number for number in every.place if number < len(bank.base)]
    if len(every.place) <= allowed(every.count):
        return []
    acting = [one for one in bank.variants if joint in one.coordinates and every.place.keys() >= {*one.columns}]
    left, result = every.without(known), list[int]()
    for _ in range(_MOST):
        best = left.standing_out(acting, every, left.count - len(known) - len(result))
        if best is None:
            break
        result += best.columns
        left = left.without(best.columns)
    return result


@dataclass(frozen=True)
class _Rows:
    """Kept rows of all runs: ``columns`` (k x N) at their ``place`` by number, ``torque`` (N), the ends of ``runs``."""

    place: Mapping[int, int]
    columns: Array
    torque: Array
    runs: Places

    @classmethod
    def of(cls, parts: Sequence[Rows]) -> _Rows:
        numbers = sorted({number for part in parts for number in part.numbers})
        place = {number: i for i, number in enumerate(numbers)}
        columns = []
        for part in parts:
            columns.append(np.zeros((len(numbers), int(part.kept.sum()))))
            columns[-1][[place[number] for number in part.numbers]] = part.columns[:, part.kept]
        torque = np.concatenate([part.tau[part.kept] for part in parts])
        return cls(place, np.concatenate(columns, axis=1), torque, np.cumsum([one.shape[1] for one in columns]))

    @property
    def count(self) -> int:
        return len(self.torque)

    def at(self, numbers: Sequence[int]) -> Array:
        return self.columns[[self.place[number] for number in numbers]]

    def without(self, numbers: Sequence[int]) -> _Rows:
        """What some columns cannot explain of all."""
        taken = self.at(numbers)
        size = np.linalg.norm(taken, axis=1, keepdims=True)
        _, values, right = np.linalg.svd(taken / np.where(size > 0, size, 1.0), full_matrices=False)
        basis = right[values > _RANK * values.max(initial=0.0)]
        columns, torque = (x - (x @ basis.T) @ basis for x in (self.columns, self.torque))
        return _Rows(self.place, columns, torque, self.runs)

    def standing_out(self, acting: Sequence[Variant], whole: _Rows, free: int) -> Variant | None:
        """The one of what is ``acting`` that stands out most, of columns that are ``whole`` without what acts, with so
        many rows ``free``.
        """
        found = []
        for one in acting:
            C = self.at(one.columns)
            x, drop = one.best(C @ C.T, C @ self.torque, _LEFT * np.sum(whole.at(one.columns) ** 2, axis=1))
            found.append((drop, one, x))
        tried = len({one.key for one in acting})
        for drop, one, x in sorted(found, key=lambda each: -each[0])[:_JUDGED]:
            e = self.torque - x @ self.at(one.columns)
            if drop > _LEAST**2 * float(e @ e) and tried * self._chance(e, one, free) < _ALPHA:
                return one
        return None

    def _chance(self, e: Array, one: Variant, free: int) -> float:
        """How likely noise of the colour of ``e`` makes the best of all shapes of a hypothesis leave so little."""
        power = float(self.torque @ self.torque)
        each = [part for part in np.split(e, self.runs[:-1]) if len(part)]
        colour = sum(inflation(part) * len(part) for part in each) / len(e)
        gain = free / colour * np.log(power / max(float(e @ e), _ROUNDING * power))
        return one.tries * float(chi2.sf(gain, len(one.columns)))
