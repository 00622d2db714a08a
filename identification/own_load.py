"""Friction that grows with the load: its columns depend on the parameters that are sought, so fits are repeated."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from identification.factors import Factor, added
from identification.least_squares import Solution
from identification.observation import Regressors
from identification.observed import Observed
from identification.sampling import Sampled

#: Fits with the load of the last one, at most, and standard deviations by which a parameter still moves at the end.
_REPEATS, _SETTLED = 20, 0.01


def under_own_load(
    runs: Sequence[Sampled], regressors: Regressors, fit: Callable[[tuple[Factor, ...]], Solution]
) -> tuple[Regressors, list[str]]:
    """The regressors with the load of the parameters that ``fit`` finds with them, and what is to be told.

    They are as they were where no column reads the load.
    """
    if not regressors.reads_load:
        return regressors, []
    notes = []
    if any(run.payload is not None for run in (one.run for one in runs)):
        notes.append("friction by load counts the load of the robot's own bodies, not that of payloads")
    before: Solution | None = None
    for _ in range(_REPEATS):
        after = fit(added([factor for one in runs for factor in Observed(one, regressors).factors]))
        if before is not None and _moved(before, after) < _SETTLED:
            return regressors, notes
        before, regressors = after, regressors.loaded_by(after.values)
    return regressors, [*notes, f"friction by load has not settled after {_REPEATS} fits"]


def _moved(before: Solution, after: Solution) -> float:
    """By how many standard deviations a parameter moved that both fits show, at most; infinite if one shows more."""
    if before.hidden != after.hidden:
        return float("inf")
    seen = [name for name in after.names if name not in after.hidden and after.std(name) > 0]
    return max((abs(after.values[name] - before.values[name]) / after.std(name) for name in seen), default=0.0)
