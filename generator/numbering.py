"""Joints, frames and bodies by their numbers, in running text."""

from __future__ import annotations

from collections.abc import Collection, Iterable


def numbered(noun: str, numbers: Collection[int], several: str = "") -> str:
    """``joint 1``, ``joints 1 to 4, 6``; ``several`` is the plural where an s does not make it."""
    return f"{noun if len(numbers) == 1 else several or f'{noun}s'} {ranges(sorted(numbers))}"


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
