"""Accelerations from torques: M qdd = b solved by a sparse factorisation from the last joint to the first.

M = L^T D L with L unit lower triangular keeps the zeros that branches leave in M (Featherstone 2008, ch. 6.5); at six
joints it costs fewer operations than the articulated-body recursion.
"""

from __future__ import annotations

import numpy as np

from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array


def solve(matrix: Array, right: Array) -> Array:
    """The solution x of M x = b for a symmetric positive definite M (n x n), without pivoting, n divisions."""
    size = len(right)
    rest = matrix.copy()
    lower: dict[tuple[int, int], Node] = {}
    inverse: list[Node] = [right[0]] * size
    for k in reversed(range(size)):
        inverse[k] = 1 / rest[k, k]
        for i in reversed(range(k)):
            lower[k, i] = rest[k, i] * inverse[k]
            for j in range(i + 1):
                rest[i, j] = rest[i, j] - lower[k, i] * rest[k, j]
    x = np.array(right, dtype=object)
    for k in reversed(range(size)):
        for i in range(k):
            x[i] = x[i] - lower[k, i] * x[k]
    for k in range(size):
        # The first pivot divides once, so that its inverse is never made.
        x[k] = x[k] * inverse[k] if k else x[k] / rest[k, k]
        for i in range(k):
            x[k] = x[k] - lower[k, i] * x[i]
    return x
