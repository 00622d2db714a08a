"""Linear recursions along samples, all at once: a triangular system of as many bands as the recursion looks back."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.linalg import lapack

from identification.arrays import Array


def recursion(factors: Sequence[Array], summands: Array) -> Array:
    """x (N) with x[i] = factors[0][i] x[i-1] + factors[1][i] x[i-2] + ... + summands[i]; ``factors`` and ``summands``
    are of N each.

    x is 0 before the first: what it is goes into the first summands. What grows beyond all numbers is none.
    """
    bands = np.zeros((len(factors) + 1, len(summands)), order="F")
    for back, each in enumerate(factors, 1):
        bands[back, : len(summands) - back] = -each[back:]
    result, _ = lapack.dtbtrs(bands, summands, uplo="L", diag="U")
    return np.asarray(result)


def from_start(factors: Array, summands: Array, start: float) -> Array:
    """z (N + 1) with z[0] = start, z[i + 1] = factors[i] z[i] + summands[i], of N ``factors`` and ``summands``."""
    summands = summands.copy()
    summands[:1] += factors[:1] * start
    return np.concatenate([[start], recursion([factors], summands)])
