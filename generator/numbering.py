"""Joints, frames and bodies by their numbers, in running text."""

from __future__ import annotations

from collections.abc import Iterable


def numbered(noun: str, numbers: Iterable[int], several: str = "") -> str:
    """``joint 1``, ``joints 1 to 4, 6``; ``several`` is the plural where an s does not make it."""
    each = sorted(set(numbers))
    return f"{noun if len(each) == 1 else several or f'{noun}s'} {ranges(each)}"


def ranges(numbers: Iterable[int]) -> str:
    """Ascending numbers with runs shortened: ``1 to 4, 6``."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    pieces = []
    for run in runs:
        pieces += [f"{run[0]} to {run[-1]}"] if len(run) > 2 else [str(number) for number in run]
    return ", ".join(pieces)
