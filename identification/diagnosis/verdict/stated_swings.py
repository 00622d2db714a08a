"""Whether the runs show the drive trains that the robot's file says are elastic: others may be of a rigid robot."""

from __future__ import annotations

import numpy as np

from identification.diagnosis.runs.stated_elasticity import BOUNCING, TOGETHER
from identification.diagnosis.search.loop import Search

#: Part of the torque of the file's elastic drive trains below which they are none, by so many standard deviations.
_ELASTIC, _SURE = 0.5, 4.0


def swing(found: Search) -> bool:
    """Whether any of the file's elastic drive trains is not clearly stiffer than stated."""
    weights = [name for name in found.bank.base if name == TOGETHER or name.startswith(BOUNCING)]
    return any(_part(found, name) is None for name in weights)


def stiffer(found: Search) -> float | None:
    """The part that the runs show of the torque of the file's drive trains without a gap, where it is clearly less than
    half; None where it is not, or there are none.
    """
    return _part(found, TOGETHER) if TOGETHER in found.values else None


def _part(found: Search, name: str) -> float | None:
    at = found.bank.base.index(name)
    part, std = found.values[name], float(np.sqrt(found.covariance[at, at]))
    return max(part, 0.0) if part + _SURE * std < _ELASTIC else None
