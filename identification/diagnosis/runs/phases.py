"""Samples or rows of a motion that repeats, by period and phase: what its periods have in common, and what differs."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array

_Scalar = TypeVar("_Scalar", np.float64, np.bool_)


def by_period(x: NDArray[_Scalar], period: int) -> NDArray[_Scalar]:
    """Rows (... x N) in periods (... x P x period), zero after the last."""
    count = -(-x.shape[-1] // period)
    padded = np.pad(x, (*((0, 0) for _ in x.shape[:-1]), (0, count * period - x.shape[-1])))
    return np.asarray(padded.reshape(*x.shape[:-1], count, period), dtype=x.dtype)


def between_periods(x: Array, kept: NDArray[np.bool_], period: int) -> Array:
    """What differs between the periods of rows (... x N), of which the last may be a part."""
    if not period:
        return x
    there = by_period(kept, period)
    mean = np.where(there, by_period(x, period), 0.0).sum(axis=-2) / np.maximum(there.sum(axis=0), 1)
    return np.asarray(np.where(kept, x - np.tile(mean, len(there))[..., : x.shape[-1]], x))
