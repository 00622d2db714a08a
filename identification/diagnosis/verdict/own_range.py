"""The range to which one run alone goes, where that holds most of what the others do not predict of it."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.views import BINS, FEW_ROWS, variables

#: Of which variables a range is looked at, and the part of what is not predicted, in squares, that it holds at least.
_RANGES, _MOST = ("q", "qd", "load"), 0.8


def own_range(found: Search, odd: int, runs: Sequence[int], joints: Collection[int]) -> str:
    """In words the range, of the joint of ``joints`` (numbers) that lacks most, to which of ``runs`` the one number
    ``odd`` alone goes; empty where it holds less than most of what a fit to the others leaves of that run.
    """
    bank, others = found.bank, [r for r in runs if r != odd]
    weights = found.weighing.fitted_to(others, found.variants)
    asked = [k for k, number in enumerate(bank.robot.numbers) if number in joints]
    excess = {k: bank.residual(odd, k, weights) ** 2 - 1 for k in asked}
    k = max(asked, key=lambda one: float(excess[one].sum()))
    every = {r: variables(bank.runs[r], bank.scenes[r], k) for r in runs}
    for name in _RANGES:
        values = {r: every[r][name][1][bank.runs[r].kept[k]] for r in runs}
        edges = np.histogram_bin_edges(np.concatenate(list(values.values())), BINS)
        alone = np.sum([np.histogram(values[r], edges)[0] for r in others], axis=0) < FEW_ROWS
        there, _ = np.histogram(values[odd], edges, weights=excess[k])
        for bins in np.split(np.arange(BINS), np.flatnonzero(np.diff(alone)) + 1):
            if alone[bins[0]] and there[bins].sum() > _MOST * there.sum():
                span = f"{edges[bins[0]]:.3g} to {edges[bins[-1] + 1]:.3g} {every[odd][name][0]}"
                return f"at {name} {span} of joint {bank.robot.numbers[k]}"
    return ""
