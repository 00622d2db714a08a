"""Samples beside those before and after them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array

#: Part of a signal's range that is the rounding of its arithmetic.
ARITHMETIC = 1e-11
#: Samples in a row at its extreme value for which something holds a signal there.
_STUCK = 10


def off_cubics(x: Array, t: Array | None = None) -> Array:
    """How far samples (... x N) are from the cubics through the two before and the two after each, but for the two at
    each end (... x N - 4); at times ``t`` (N), even ones without.
    """
    before, after = (x[..., :-4], x[..., 1:-3]), (x[..., 3:-1], x[..., 4:])
    if t is None:
        return np.asarray(x[..., 2:-2] - (4 * (before[1] + after[0]) - before[0] - after[1]) / 6)
    near = np.stack([t[:-4], t[1:-3], t[3:-1], t[4:]]) - t[2:-2]
    weights = [np.prod([b / (b - a) for b in np.delete(near, i, axis=0)], axis=0) for i, a in enumerate(near)]
    return np.asarray(x[..., 2:-2] - np.einsum("im,i...m->...m", np.array(weights), np.stack([*before, *after])))


def in_a_row(there: NDArray[np.bool_]) -> list[slice]:
    """Samples (of N) one beside the other that are ``there``."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], there, [False]]).astype(np.int8))).tolist()
    return [slice(start, end) for start, end in zip(edges[::2], edges[1::2], strict=True)]


def at_extremes(x: Array) -> list[slice]:
    """Stretches of a signal (N) that are held at the largest value, then those at the smallest."""
    found = [one for extreme in (x.max(), x.min()) for one in in_a_row(x == extreme)]
    return [one for one in found if one.stop - one.start >= _STUCK]
