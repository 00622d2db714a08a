"""By how much a coloured residual makes estimates less certain than a white one of the same size."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from identification.arrays import Array

#: Lags looked at, as a part of the samples, and their largest number.
_PART, _MOST = 0.1, 200


def inflation(e: Array) -> float:
    """Variance of the mean of ``e`` (N, in time order) over that of white noise, 1 + 2 sum of its correlations.

    The sum ends before the first of the pairs of lags (1, 2), (3, 4) ... whose sum is not positive: like the initial
    positive sequence of Geyer (1992), whose pairs begin with lag 0. Never below 1.
    """
    e = e - e.mean() if e.size else e
    power = float(e @ e)
    if power == 0.0:
        return 1.0
    last = min(int(_PART * len(e)), _MOST)
    correlation = [float(e[k:] @ e[:-k]) / power for k in range(1, last + 1)]
    total = 1.0
    for k in range(0, len(correlation) - 1, 2):
        pair = correlation[k] + correlation[k + 1]
        if pair <= 0:
            break
        total += 2 * pair
    return max(total, 1.0)


def scatter(instruments: Sequence[Array], errors: Sequence[Array], unknowns: int) -> float:
    """Standard deviation of the sum of z e over runs with instruments z (N each) and residuals e (N each) that so
    many ``unknowns`` leave; noise and its colour are each run's own.
    """
    rows = sum(map(len, errors))
    parts = [float(z @ z) * float(e @ e) / len(e) * inflation(e) for z, e in zip(instruments, errors, strict=True)]
    return float(np.sqrt(sum(parts) * rows / max(rows - unknowns, 1)))
