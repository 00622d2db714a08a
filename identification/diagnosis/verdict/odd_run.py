"""Runs that do not agree: the one without which all others do, or two that are explained one by one."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from generator.words import listed
from identification.diagnosis.runs.told_files import paths, told_files
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.lack_of_fit import CHANCE, lack_of_fit
from identification.diagnosis.verdict.of_rounding import of_rounding
from identification.diagnosis.verdict.own_range import own_range

#: Part of what is unexplained, in squares, that stays without the odd run, and without any other one; and by how much
#: that is more.
_GONE, _STAYS, _MORE = 0.2, 0.15, 3.0
#: What one run may have and the others not.
_OTHER = "another load, zero, unit or sign, or drives less or more warm (since_cold of a sidecar)"


def notes(found: Search, lacking: Collection[int]) -> list[str]:
    """What is to be told of them, if there are such, where joints by number are ``lacking`` something."""
    runs = (*found.train, *found.validate)
    recorded = [found.bank.runs[r].sampled.run for r in runs]
    if len({*paths(recorded)}) < max(len(runs), 2):
        return []
    names = dict(zip(runs, told_files(recorded), strict=True))
    whole = _unexplained(found, runs, lacking)
    left = {r: _unexplained(found, [other for other in runs if other != r], lacking) / whole for r in runs if whole}
    odd = min(left, key=lambda r: left[r], default=-1)
    gone = [r for r in left if left[r] < _GONE]
    if len(runs) == len(gone) == 2:
        return [f"{listed([*names.values()])} do not agree, each alone is explained: look for {_OTHER} in one of them"]
    if len(runs) > 2 and odd in gone and all(left[r] > max(_STAYS, _MORE * left[odd]) for r in left if r != odd):
        name, where = names[odd], own_range(found, odd, runs, lacking)
        told = f"without {name} the other runs agree"
        kept = f"; most of what it keeps is where they do not go, {where}" if where else ""
        # What has another load, zero, unit or sign is explained by itself.
        if _unexplained(found, [odd], lacking) < _GONE * whole:
            return [f"{told}{kept}: look {'there, or ' if where else ''}for {_OTHER} in it"]
        return [f"{told}{kept}: look there" if where else f"most of what is missing shows in {name} alone"]
    return []


def _unexplained(found: Search, runs: Sequence[int], joints: Collection[int]) -> float:
    """What a fit of the model with what was found to some runs leaves of ``joints`` beyond chance, in squares."""
    bank, weights = found.bank, found.weighing.fitted_to(runs, found.variants)
    result = 0.0
    for k, number in enumerate(bank.robot.numbers):
        if number in joints:
            left, rounded = [bank.residual(r, k, weights) for r in runs], of_rounding(found, k, runs)
            lack = lack_of_fit([bank.runs[r] for r in runs], left, k, number, rounded=rounded)
            result += lack.size**2 if lack.p < CHANCE else 0.0
    return result
