"""How far estimates scatter, beside what is expected of them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import stats

Array = NDArray[np.float64]


def squares(errors: Sequence[Sequence[float]], std: Array) -> Array:
    """Variances (p) of ``errors``, one row of p each run, in parts of those that are expected, times the degrees of
    freedom; all are within what chance allows in a thousandth of such sets.
    """
    count, p = np.shape(errors)
    result: Array = (np.std(errors, axis=0, ddof=1) / std) ** 2 * (count - 1)
    tail = 0.001 / p / 2
    lower, upper = stats.chi2.ppf([tail, 1 - tail], count - 1)
    assert (result > lower).all()
    assert (result < upper).all()
    return result
