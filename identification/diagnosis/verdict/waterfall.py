"""From the residual of the model as it was down to the noise, finding by finding."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from identification.diagnosis.columns.bank import Variant, columns_of
from identification.diagnosis.columns.normal_equations import Normal
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.trial import Trial
from identification.residuals import rms


@dataclass(frozen=True)
class Steps:
    """Findings ``named`` in words, what explains most first, and the rms of the white residual before them and with one
    after the other (``sizes``, one more), all joints together: 1 is noise alone. Parameters are fitted anew each time.

    ``tested`` tells whether it is that of runs which are not fitted.
    """

    named: tuple[str, ...]
    sizes: tuple[float, ...]
    tested: bool


def steps(found: Search, trial: Trial | None) -> Steps:
    """Of the runs that test, or where there are none of those that are fitted and validate."""
    ranked = sorted(found.choices, key=lambda one: -one.evidence.drop)
    variants = [one.evidence.variant for one in ranked]
    partly = [variants[:count] for count in range(len(variants) + 1)]
    sizes = _of_trial(trial, partly) if trial else _of_fit(found.weighing.all, partly)
    return Steps(tuple(one.hypothesis.named for one in variants), sizes, trial is not None)


def _of_trial(trial: Trial, partly: Sequence[Sequence[Variant]]) -> tuple[float, ...]:
    """The rms of what fits to the other runs leave, in parts of the noise that those have in the mean."""
    left = [trial.left(trial.fitted(variants)[0]) / trial.usual for variants in partly]
    return tuple(rms(e) for e in left)


def _of_fit(normal: Normal, partly: Sequence[Sequence[Variant]]) -> tuple[float, ...]:
    columns = [columns_of(variants) for variants in partly]
    squares = [normal.misfit(numbers, normal.solution(numbers)[0]) for numbers in columns]
    return tuple(float(np.sqrt(max(one, 0.0) / max(normal.rows, 1))) for one in squares)
