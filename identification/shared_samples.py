"""Runs that have samples in common: what is fitted twice counts twice, and what is fitted does not test."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from pathlib import Path

from generator.errors import InputError
from identification.dataset import Run


def unshared(runs: Mapping[str, Sequence[Run]]) -> None:
    """Refuses runs, by what they do, that are of one recording and share samples."""
    every = [(run, use) for use, mine in runs.items() for run in mine]
    for (one, use), (other, again) in combinations(every, 2):
        start = max(one.start, other.start)
        end = min(each.start + (each.samples - 1) * each.period for each in (one, other))
        if one.sha256 == other.sha256 and end - start > max(one.period, other.period):
            twice = f"{use} in {Path(one.name).name} and {again} in {Path(other.name).name}"
            raise InputError(
                other.place, f"its samples from {start:g} s to {end:g} s {twice}", "runs, or parts, that share none"
            )
