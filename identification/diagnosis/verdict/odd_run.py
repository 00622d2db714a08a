"""Runs that do not agree: the one without which all others do, or two that are explained one by one."""

from __future__ import annotations

from generator.review.words import listed
from identification.diagnosis.columns.bank import columns_of
from identification.diagnosis.search.loop import Search

#: Part of what is unexplained, in squares, that stays without the odd run, and without any other one.
_GONE, _STAYS = 0.2, 0.3
#: What one run may have and the others not.
_OTHER = "another load, zero, unit, sign or temperature"


def notes(found: Search) -> list[str]:
    """What is to be told of them, if there are such."""
    runs, columns = (*found.train, *found.validate), columns_of(found.variants)
    if len({found.bank.runs[r].sampled.run.file for r in runs}) < len(runs):
        return []
    whole = found.weighing.excess(runs, columns)
    left = {r: found.weighing.excess([other for other in runs if other != r], columns) / whole for r in runs if whole}
    gone = [r for r in left if left[r] < _GONE]
    names = [found.bank.runs[r].sampled.run.file for r in gone]
    if len(runs) == len(gone) == 2:
        return [f"{listed(names)} do not agree, each alone is explained: look for {_OTHER} in one of them"]
    if len(runs) > 2 and len(gone) == 1 and all(left[r] > _STAYS for r in left if r not in gone):
        return [f"without {names[0]} the other runs agree: look for {_OTHER} there"]
    return []
