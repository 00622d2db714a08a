"""Runs that have samples in common: what is fitted twice counts twice, and what is fitted does not test."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, product
from pathlib import Path

import numpy as np

from generator.errors import InputError
from identification.dataset import Run

#: Part of a signal's spread by which a copy may be rounded.
_ROUNDED = 1e-6


def unshared(runs: Mapping[str, Sequence[Run]]) -> None:
    """Refuses runs, by what they do, that are of one recording and share samples."""
    every = [(run, use) for use, mine in runs.items() for run in mine]
    for (one, use), (other, again) in combinations(every, 2):
        if common := _common(one, other):
            twice = f"{use} in {Path(one.name).name} and {again} in {Path(other.name).name}"
            raise InputError(other.place, f"its samples {common} {twice}", "runs, or parts, that share none")


def fitted_too(fitted: Sequence[Run], tested: Sequence[Run]) -> Iterator[str]:
    """What is to be told of runs that test samples which are fitted."""
    for one, other in product(fitted, tested):
        if common := _common(one, other):
            source, test = (Path(each.name).name for each in (one, other))
            yield f"{test} tests what is fitted in {source}, {common}: it proves nothing new"


def _common(one: Run, other: Run) -> str:
    """The time that two runs share, in words."""
    start = max(one.start, other.start)
    end = min(each.start + each.length for each in (one, other))
    if end - start <= max(one.period, other.period):
        return ""
    shared = one.sha256 == other.sha256 or _copied(one, other, start, end)
    return f"from {start:g} s to {end:g} s" if shared else ""


def _copied(one: Run, other: Run, start: float, end: float) -> bool:
    """Whether two files hold the same samples from ``start`` to ``end`` [s], as one that was saved again."""
    if not np.isclose(one.period, other.period, rtol=_ROUNDED, atol=0.0):
        return False
    count = int((end - start) / one.period) + 1
    first = [round((start - each.start) / each.period) for each in (one, other)]
    for x, y in ((one.tau, other.tau), (one.q, other.q)):
        mine, its = (each[:, k : k + count] for each, k in zip((x, y), first, strict=True))
        if mine.shape != its.shape or np.any(np.abs(mine - its) > _ROUNDED * np.ptp(mine, axis=1, keepdims=True)):
            return False
    return True
