"""Friction that grows with the load: its columns depend on the parameters that are sought, so fits are repeated."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from identification.factors import Factor, added
from identification.observation import Regressors
from identification.observed import Observed
from identification.sampling import Sampled

#: Fits with the load of the last one, at most, and standard deviations by which a parameter still moves at the end.
_REPEATS, _SETTLED = 20, 0.01


class Fitted(Protocol):
    """What a fit found."""

    @property
    def names(self) -> Sequence[str]:
        """The parameters that were sought."""

    @property
    def values(self) -> Mapping[str, float]:
        """Of all parameters [SI] by name, payloads' and given ones among them."""

    @property
    def hidden(self) -> Sequence[str]:
        """Those of the sought ones that nothing shows."""

    def std(self, name: str) -> float:
        """Standard deviation of a parameter [SI]."""


def under_own_load(
    runs: Sequence[Sampled], regressors: Regressors, fit: Callable[[tuple[Factor, ...]], Fitted]
) -> tuple[Regressors, list[str]]:
    """As ``settled``, with a ``fit`` to the factors of all ``runs``."""

    def again(with_load: Regressors) -> Fitted:
        return fit(added([factor for one in runs for factor in Observed(one, with_load).factors]))

    return settled(regressors, again)


def settled(regressors: Regressors, fit: Callable[[Regressors], Fitted]) -> tuple[Regressors, list[str]]:
    """The regressors with the load of the parameters that ``fit`` finds with them, and what is to be told.

    They are as they were where no column reads the load.
    """
    if not regressors.reads_load:
        return regressors, []
    before: Fitted | None = None
    for _ in range(_REPEATS):
        after = fit(regressors)
        if before is not None and _moved(before, after) < _SETTLED:
            return regressors, []
        before, regressors = after, regressors.loaded_by(after.values)
    return regressors, [f"friction by load has not settled after {_REPEATS} fits"]


def _moved(before: Fitted, after: Fitted) -> float:
    """By how many standard deviations a parameter moved that both fits show, at most; infinite if one shows more."""
    if before.hidden != after.hidden:
        return float("inf")
    seen = [name for name in after.names if name not in after.hidden and after.std(name) > 0]
    return max((abs(after.values[name] - before.values[name]) / after.std(name) for name in seen), default=0.0)
