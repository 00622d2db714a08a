"""How much of a residual is a sum of some rows, and how likely chance makes as much of it: an F test."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import f

from identification.arrays import Array

#: Least singular value of rows, in parts of the largest, that counts.
_RANK = 1e-6
#: Values of the residual for each direction that is tried, at least: white noise is not quite Gaussian.
_VALUES = 5


@dataclass(frozen=True)
class FTest:
    """The ``part`` of the squares that rows of ``rank`` explain; the ``ratio`` of means of squares is 1 for noise and
    has the p-value ``p``.
    """

    rank: int
    part: float
    ratio: float
    p: float


def f_test(X: Array, e: Array, fitted: int) -> FTest:
    """What the rows of X (m x N) explain of the residual e (N) of a fit of ``fitted`` values, beyond what as many rows
    of noise do; nothing where e has few values beside those.
    """
    _, s, V = np.linalg.svd(X, full_matrices=False)
    V = V[s > _RANK * s.max(initial=0.0)]
    rank, free, whole = len(V), len(e) - fitted - len(V), float(e @ e)
    if not rank or free < _VALUES * rank or not whole:
        return FTest(rank, 0.0, 1.0, 1.0)
    along = float(np.sum((V @ e) ** 2))
    ratio = (along / rank) / max((whole - along) / free, 1e-300)
    return FTest(rank, along / whole, ratio, float(f.sf(ratio, rank, free)))
