"""What the runs that test say of each finding: they choose nothing, but what they contradict is taken back.

The model with a finding and the one without it, both fitted to the other runs, predict torques of the testing runs that
differ by d, in units of the noise. Where the finding is true the sum of squares falls by |d|^2 + 2 e d with it, e what
the model with it leaves: noise, the uncertainty of the fit, and whatever else is new there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.search.loop import Search
from identification.diagnosis.search.selection import Choice, Selection
from identification.diagnosis.verdict.trial import Trial

#: Least |d|^2 at which the testing runs tell anything of a finding.
_TOLD = 9.0
#: Standard deviations by which a true finding never falls short.
_NEVER = 3.0


def confirmed(found: Search, trial: Trial | None) -> tuple[Search, tuple[Choice, ...]]:
    """The search without the choices that ``trial`` contradicts, and those; the most contradicted goes first.

    What passed only beside one that is taken back goes too.
    """
    if trial is None:
        return found, ()
    staying = found.variants
    while staying:
        short, worst = min(((_short(trial, staying, one), one) for one in staying), key=lambda pair: pair[0])
        if short >= 0:
            break
        staying.remove(worst)
    if len(staying) == len(found.choices):
        return found, ()
    again = Selection(found.weighing).choices(staying)
    kept = {one.evidence.variant.key for one in again}
    gone = tuple(one for one in found.choices if one.evidence.variant.key not in kept)
    away = {one.evidence.variant.key for one in gone}
    told = [
        replace(one, alternatives=tuple(other for other in one.alternatives if other.variant.key not in away))
        for one in again
    ]
    return found.keeping(told), gone


def _short(trial: Trial, staying: Sequence[Variant], one: Variant) -> float:
    """By how many standard deviations the testing runs contradict a finding beside the others, negative; else 0."""
    theta, C = trial.fitted(staying)
    fewer, _ = trial.fitted([other for other in staying if other is not one])
    d = (theta - fewer) @ trial.columns
    size = float(d @ d)
    if size < _TOLD:
        return 0.0
    left = trial.left(theta)
    gained = size + float(2 * left @ d)
    along = trial.columns @ d
    variance = 4 * (float(np.mean(left**2)) * size + float(along @ C @ along))
    if gained >= 0 or gained >= size - _NEVER * np.sqrt(variance):
        return 0.0
    return (gained - size) / float(np.sqrt(variance))
