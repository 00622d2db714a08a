"""Runs that have samples in common: what is fitted twice counts twice, and what is fitted does not test."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, product
from pathlib import Path

from generator.errors import InputError
from identification.dataset import Run


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
    shared = one.sha256 == other.sha256 and end - start > max(one.period, other.period)
    return f"from {start:g} s to {end:g} s" if shared else ""
