"""A joint that stands from a recording's first sample to its last."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array

#: Range [rad, m] within which it does: what moves it less is noise, and so is its speed.
_WITHIN = 2e-3


def stands_throughout(q: Array) -> NDArray[np.bool_]:
    """Whether joints do whose positions (n x N, or N of one) [rad, m] are ``q``: (n), or of the one."""
    return np.asarray(np.ptp(q, axis=-1) < _WITHIN)
