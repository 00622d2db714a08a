"""Long signals made short enough for a page, so that nothing that stands out is lost."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array
from identification.colour import inflation

#: Numbers for a page, None for a gap.
Numbers = list[float | None]

#: Points of all lines of one kind on a page, and the most and the fewest of one line.
_ALL, _MOST, _FEWEST = 48_000, 1600, 160
#: Significant digits of a number that is exact.
_EXACT = 17
#: Distance of two samples, in the usual one, from which a line is interrupted.
_GAP = 1.5


def points_each(lines: int) -> int:
    """Points of a line where a page has so many of its kind."""
    return int(np.clip(_ALL // max(lines, 1), _FEWEST, _MOST))


def extremes(y: Array, count: int) -> NDArray[np.int64]:
    """Indices of about ``count`` samples: the least and the largest of each of ``count``/2 stretches of ``y`` (N)."""
    if len(y) <= count:
        return np.arange(len(y))
    edges = np.linspace(0, len(y), max(count // 2, 1) + 1).astype(int)
    found = [a + f(y[a:b]) for a, b in pairwise(edges) for f in (np.argmin, np.argmax)]
    return np.unique(found)


def thinned(x: Array, y: Array, count: int) -> tuple[Numbers, Numbers]:
    """About ``count`` points of y over increasing x (N each), interrupted (None) where samples are missing."""
    kept = extremes(y, count)
    steps = np.diff(x)
    missing = np.concatenate([[0], np.cumsum(steps > _GAP * np.median(steps))]) if len(x) > 1 else np.zeros(len(x))
    breaks = np.flatnonzero(np.diff(missing[kept])) + 1
    across: Numbers = resolved(x[kept], 7)
    upward: Numbers = numbers(y[kept])
    for at in breaks[::-1]:
        across.insert(at, across[at])
        upward.insert(at, None)
    return across, upward


def numbers(values: Iterable[float | None], digits: int = 5) -> Numbers:
    """Numbers with so many significant digits; None for what is none, or not finite."""
    return [float(f"{value:.{digits}g}") if value is not None and np.isfinite(value) else None for value in values]


def resolved(values: Array, digits: int = 5) -> Numbers:
    """Numbers with so many significant digits of their range, however far from zero they are."""
    finite = values[np.isfinite(values)]
    span = np.ptp(finite) if finite.size else 0.0
    more = math.ceil(math.log10(np.abs(finite).max() / span)) if span else 0
    return numbers(values, min(digits + max(more, 0), _EXACT))


def some(count: int, most: int) -> NDArray[np.int64]:
    """Indices of at most ``most`` of ``count`` samples, evenly spread."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).astype(int)) if count else np.arange(0)


@dataclass(frozen=True)
class Means:
    """Classes of a variable ``x``, and the mean of a signal in each with its standard deviation."""

    x: Array
    mean: Array
    std: Array


def binned(x: Array, y: Array, classes: int = 24, fewest: int = 8) -> Means:
    """Means of y (N, in time order) over classes of x (N) with equal numbers of samples, ``fewest`` at least.

    Standard deviations allow for the colour of y (``colour.inflation``).
    """
    count = min(classes, len(x) // fewest)
    if not count:
        return Means(np.empty(0), np.empty(0), np.empty(0))
    parts = np.array_split(np.argsort(x, kind="stable"), count)
    colour = np.sqrt(inflation(y))
    std = [y[part].std(ddof=1) / np.sqrt(len(part)) * colour for part in parts]
    return Means(*(np.array(one) for one in ([x[p].mean() for p in parts], [y[p].mean() for p in parts], std)))
