"""The range to which one run alone goes, where that holds most of what the others do not predict of it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

import numpy as np

from generator.words import listed
from identification.arrays import Array
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.views import BINS, FEW_ROWS, variables

#: Of which variables a range is looked at, and what it is told of: a speed whichever its direction.
_RANGES: Mapping[str, tuple[str, Callable[[Array], Array]]] = {
    "q": ("q", np.asarray),
    "qd": ("|qd|", np.abs),
    "load": ("load", np.asarray),
}
#: The part of what is not predicted, in squares, that all of it holds at least, and each piece of it that is told.
_MOST, _PART = 0.8, 0.1


def own_range(found: Search, odd: int, runs: Sequence[int], joints: Collection[int]) -> str:
    """In words the range, of the joint of ``joints`` (numbers) that lacks most, to which of ``runs`` the one number
    ``odd`` alone goes; empty where it holds less than most of what a fit to the others leaves of that run.
    """
    bank = found.bank
    weights = found.weighing.fitted_to([r for r in runs if r != odd], found.variants)
    asked = [k for k, number in enumerate(bank.robot.numbers) if number in joints]
    excess = {k: bank.residual(odd, k, weights) ** 2 - 1 for k in asked}
    k = max(asked, key=lambda one: float(excess[one].sum()))
    every = {r: variables(bank.runs[r], bank.scenes[r], k) for r in runs}
    for name, (told, of) in _RANGES.items():
        unit, values = every[odd][name][0], {r: of(every[r][name][1][bank.runs[r].kept[k]]) for r in runs}
        edges = np.histogram_bin_edges(np.concatenate(list(values.values())), BINS)
        others = np.sum([np.histogram(values[r], edges)[0] for r in runs if r != odd], axis=0)
        alone = (others < FEW_ROWS) & (np.histogram(values[odd], edges)[0] > 0)
        there, _ = np.histogram(values[odd], edges, weights=excess[k])
        if there.sum() > 0 and there[alone].sum() > _MOST * there.sum():
            spans = [
                f"{edges[bins[0]]:.3g} to {edges[bins[-1] + 1]:.3g}"
                for bins in np.split(np.arange(BINS), np.flatnonzero(np.diff(alone)) + 1)
                if alone[bins[0]] and there[bins].sum() > _PART * there.sum()
            ]
            if spans:
                return f"at {told} {listed(spans)} {unit} of joint {bank.robot.numbers[k]}"
    return ""
