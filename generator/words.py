"""Lists and numbers in running text."""

from __future__ import annotations

import re
from collections.abc import Iterable


def listed(words: Iterable[str]) -> str:
    """``a, b and c``."""
    *most, last = words
    return f"{', '.join(most)} and {last}" if most else last


def plural(count: int, noun: str) -> str:
    """``1 joint``, ``6 joints``."""
    return f"{count} {noun if count == 1 else noun + 's'}"


def unit(symbol: str) -> str:
    """A unit with its powers raised and no break inside: ``kg m²``."""
    return re.sub(r"(?<=[A-Za-z])[23]\b", lambda power: "²³"[int(power.group()) - 2], symbol).replace(" ", "\u00a0")


def bounds(lower: float | None, upper: float | None, positive: bool = False) -> str:
    """``≥ 0, ≤ 1``; what is ``positive`` is not at its lower bound. Empty without bounds."""
    ends = [] if lower is None else [f"{'>' if positive else '≥'}\u00a0{lower:g}"]
    ends += [] if upper is None else [f"≤\u00a0{upper:g}"]
    return ", ".join(ends)


def minus(text: str) -> str:
    """Text with typographic minus signs."""
    return text.replace("-", "−")


def numbered(noun: str, numbers: Iterable[int], several: str = "") -> str:
    """``joint 1``, ``joints 1 to 4 and 6``; ``several`` is the plural where an s does not make it."""
    each = sorted(set(numbers))
    return f"{noun if len(each) == 1 else several or f'{noun}s'} {listed(ranges(each))}"


def ranges(numbers: Iterable[int]) -> list[str]:
    """Ascending numbers with runs shortened: ``1 to 4``, ``6``."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    pieces: list[str] = []
    for run in runs:
        pieces += [f"{run[0]} to {run[-1]}"] if len(run) > 2 else [str(number) for number in run]
    return pieces
