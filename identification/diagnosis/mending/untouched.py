"""What the runs that were not fitted say of the old and the new model, and how far both are from the noise."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.hypothesis import VALUE
from identification.diagnosis.columns.whitening import at_rate, colour, stretches
from identification.diagnosis.noise.noise_floor import noise_floor
from identification.diagnosis.runs.played import Played, together
from identification.diagnosis.verdict.finding import Finding
from identification.residuals import Residual, rms

#: Least gap to the noise, in squares of the residual, of which a share is told.
_GAP = 0.25
#: How much more of a joint a model must leave to be worse; and how much more than noise, to lack something, in its rms.
_WORSE, _LACKING = 1.05, 2.0
#: How far above their own noise runs are, at most, that are only noisier.
_NOISIER = 1.25


@dataclass(frozen=True)
class Untouched:
    """A joint of the untouched runs: residual of the model before and of the one after, rms of noise [N m, N] by the
    fitted runs, and how many times as large what no row before foretells is as in those.
    """

    before: Residual
    after: Residual
    floor: float
    louder: float = 1.0

    @property
    def relative_floor(self) -> float:
        """What noise alone would leave, in % of the torque's spread."""
        return 100 * self.floor * float(np.sqrt(self.before.rows)) / self.before.spread if self.before.spread else 0.0

    @property
    def worse(self) -> bool:
        """Whether the model after leaves more, in parts of the torque's spread."""
        return self.after.relative_to_mean > _WORSE * self.before.relative_to_mean

    @property
    def lacking(self) -> bool:
        """Whether the model after leaves far more than noise."""
        return self.after.relative_to_mean > _LACKING * self.relative_floor

    @property
    def noisier(self) -> bool:
        """Whether it may be noise of these runs' own, as it is from row to row: what most models lack is smoother."""
        return self.after.relative_to_mean < _NOISIER * self.louder * self.relative_floor

    @property
    def alike(self) -> bool:
        """Whether both leave as much."""
        return not self.worse and self.before.relative_to_mean <= _WORSE * self.after.relative_to_mean

    @property
    def closed(self) -> float | None:
        """The share of the gap between ``before`` and the noise that is closed, in squares of parts of the torque's
        spread, which a gain changes too; None without a gap.
        """
        before, after = (one.relative_to_mean**2 for one in (self.before, self.after))
        gap = before - self.relative_floor**2
        return (before - after) / gap if gap > _GAP * before else None


def untouched(bank: Bank, before: Sequence[Played], after: Sequence[Played]) -> dict[int, Untouched]:
    """By the joint's number, all runs together; joints without rows are left out, and those of which ``bank`` has none.

    The noise is that of the runs in ``bank``, at the rate of these rows.
    """
    old, new = together(before).per_joint, together(after).per_joint
    return {
        joint.number: Untouched(old[k], new[k], noise_floor(bank, k, after[0].rate), _louder(bank, k, after))
        for k, joint in enumerate(bank.robot.moving)
        if old[k].rows and new[k].rows and k in bank.shown
    }


def _louder(bank: Bank, k: int, after: Sequence[Played]) -> float:
    """What no row before foretells of the residuals of coordinate k, in parts of that of the fitted runs' noise."""
    rows = [part for one in after for part in stretches(one.measured[k] - one.model[k], one.kept[k])]
    usual = [
        at_rate(colours[k], run.rate, after[0].rate).deviations[-1]
        for run, colours in zip(bank.runs, bank.colours, strict=True)
    ]
    return colour(rows).deviations[-1] / rms(np.array(usual))


def objections(tried: Mapping[int, Untouched], runs: str, unwritten: Collection[int] = ()) -> list[str]:
    """What ``runs`` (in words) on which models were ``tried`` say against the one after: joints that it explains less
    well, or not down to the noise; and joints on which they may only be noisier.

    A share is that of the torque's spread. A model without what was found and is ``unwritten``, on joints by number,
    leaves more than noise there.
    """
    worse = [
        f"joint {number} ({one.before.relative_to_mean:.3g} % without what was found, "
        f"{one.after.relative_to_mean:.3g} % with it)"
        for number, one in tried.items()
        if one.worse
    ]
    far = {number: one for number, one in tried.items() if number not in unwritten and one.lacking}
    lacking, noisier = (
        [
            f"joint {number} ({one.after.relative_to_mean:.3g} %, noise {one.relative_floor:.2g} %)"
            for number, one in far.items()
            if one.noisier == noise
        ]
        for noise in (False, True)
    )
    notes = []
    if worse:
        notes.append(f"the new model explains the {runs} less well on {', '.join(worse)}")
    if lacking:
        where = ", ".join(lacking)
        notes.append(
            f"the {runs} keep far more than noise on {where}: the model lacks more than was found, or they show"
            " what the others did not"
        )
    if noisier:
        notes.append(
            f"the {runs} keep far more than the fitted ones' noise on {', '.join(noisier)}: as much more changes from"
            " row to row, so they may only be noisier; or the model lacks something as quick, such as a ripple"
        )
    return notes


def hardly_shown(tried: Mapping[int, Untouched], runs: str, found: Sequence[Finding]) -> Iterator[str]:
    """Findings without which their joints are as near to the noise as with them, and joints on which nothing else was
    found: ``runs`` tell nothing of them. A fit without a finding may spoil other joints to make up for it.

    It is not asked of another value than the known one, which a fit without the finding takes up.
    """
    for one in found:
        if one.hypothesis.kind == VALUE:
            continue
        others = {number for other in found if other is not one for number in other.amplitude}
        mine = [each for number, each in tried.items() if number in one.amplitude or number not in others]
        if mine and all(each.closed is None and each.alike for each in mine):
            yield f"{one.hypothesis.named} hardly shows on the {runs}: without it little more than noise is left there"
