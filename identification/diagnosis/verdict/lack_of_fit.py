"""How much of a joint's residual no noise explains: between repetitions, or beyond the noise's power; and events.

Where a motion repeats, what the periods of the residual have in common is what the model lacks, and what differs is
noise (an F test). Along runs that do not repeat the residual's power is compared with that of the noise, which is
weaker: the noise was measured on the same rows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2, f

from identification.arrays import Array
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.verdict.burst import Burst, burst

#: Chance below which more than noise is left.
CHANCE = 1e-4
#: Size from which it is told from noise; where nothing repeats, nor follows the motion, the noise is not known apart
#: from the model.
_SMALL, _APERIODIC = 0.2, 0.5
#: Degrees of freedom between periods from which they are compared.
_COMPARED = 50


@dataclass(frozen=True)
class Lack:
    """Of a joint: the part ``size`` of the noise's rms that the model leaves unexplained, ratio and p-value.

    ``ratio`` is 1 when the model is right. ``repeats`` tells whether periods were compared; ``follows`` what of the
    motion it follows, where that was compared with the rest. ``burst`` is what happens for a moment, None where nothing
    does.
    """

    joint: int
    ratio: float
    p: float
    size: float
    repeats: bool
    burst: Burst | None = None
    follows: str = ""

    @property
    def event(self) -> str:
        """What happens on the joint for a moment, in words: when; empty where nothing does."""
        return "" if self.burst is None else self.burst.words

    @property
    def part(self) -> float:
        """The size in parts of that from which it is told from noise; 0 where it may be chance."""
        known = self.repeats or self.follows
        return self.size / (_SMALL if known else _APERIODIC) if self.p < CHANCE else 0.0

    @property
    def told(self) -> bool:
        """Whether it is told from noise."""
        return self.part > 1

    @property
    def hardly(self) -> bool:
        """Whether it is beyond chance, and told from noise if only that were known apart from the model."""
        return self.p < CHANCE and self.size > _SMALL and not self.told


def lack_of_fit(
    runs: Sequence[Prepared],
    residuals: Sequence[Array],
    k: int,
    number: int,
    late: Sequence[Array] | None = None,
    rounded: float = 0.0,
) -> Lack:
    """Of the residuals of coordinate k, joint ``number``: kept rows, one a run; noise in them is white with power 1.

    ``late`` are the same rows of what may come a little late: swings that were found of elastic drive trains, and jumps
    of the torque between two samples. What they leave then is no event of its own. ``rounded`` is the part of the
    noise's power that periods have in common, since it is rounding of positions and efforts.
    """
    common, differing, phases, freedom, repeats = 0.0, 0.0, 0, 0, 0.0
    for run, e in zip(runs, residuals, strict=True):
        if not run.period:
            continue
        phase = np.flatnonzero(run.kept[k]) % run.period
        count = np.bincount(phase, minlength=run.period)
        mean = np.bincount(phase, weights=e, minlength=run.period) / np.maximum(count, 1)
        twice = count > 1
        common += float(count[twice] @ mean[twice] ** 2)
        inside = twice[phase]
        differing += float(((e - mean[phase])[inside] ** 2).sum())
        phases += int(twice.sum())
        freedom += int(inside.sum()) - int(twice.sum())
        repeats += float(count[twice].sum())
    happens = burst(runs, residuals, k, late or [np.zeros_like(e) for e in residuals])
    if not phases or freedom <= _COMPARED:
        return _powerful(residuals, number, happens)
    ratio = (common / phases) / max(differing / freedom + rounded, 1e-300)
    size = float(np.sqrt(max(ratio - 1, 0.0) * phases / repeats))
    compared = Lack(number, float(ratio), float(f.sf(ratio, phases, freedom)), size, True, happens)
    others = [e for run, e in zip(runs, residuals, strict=True) if not run.period]
    return max(compared, _powerful(others, number, happens), key=lambda one: one.part)


def _powerful(residuals: Sequence[Array], number: int, happens: Burst | None) -> Lack:
    """Of the power of white residuals against that of the noise."""
    rows = sum(len(e) for e in residuals)
    power = sum(float(e @ e) for e in residuals)
    ratio = power / max(rows, 1)
    p = float(chi2.sf(power, rows)) if rows else 1.0
    return Lack(number, ratio, p, float(np.sqrt(max(ratio - 1, 0.0))), False, happens)
