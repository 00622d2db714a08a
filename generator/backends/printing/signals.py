"""Signals in words: shapes, units and entries, as the comments of generated code state them."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Sequence
from itertools import groupby

from generator.symbolic.function import Function, Signal

#: More changes of unit than this along a signal say less than its meaning does.
_RUNS = 4


def units(signal: Signal) -> str:
    """``rad``, or the units by flat index: ``N at 0..2, N m at 3..5``."""
    if len(set(signal.units)) <= 1:
        return next(iter(signal.units), "1")
    runs = [(unit, [place for place, _ in run]) for unit, run in groupby(enumerate(signal.units), key=lambda e: e[1])]
    if len(runs) > _RUNS:
        return "SI"
    return ", ".join(f"{unit} at {_span(places)}" for unit, places in runs)


def _span(places: list[int]) -> str:
    return f"{places[0]}..{places[-1]}" if len(places) > 1 else str(places[0])


def shape(signal: Signal) -> str:
    """``6``, ``6 x 59``; ``scalar`` for a signal of one number."""
    return " x ".join(map(str, signal.shape)) or "scalar"


def described(signal: Signal) -> str:
    """Shape, meaning and units in one phrase."""
    return f"({shape(signal)}) {signal.meaning} [{units(signal)}]"


def safe(text: str) -> str:
    """``text`` on one line, with nothing that would begin or end a comment of C, or a docstring of Python."""
    # Trigraphs, of which one joins a line with the next.
    text = re.sub(r"\?(?=\?)", "? ", text)
    return " ".join(text.replace("*/", "* /").replace("/*", "/ *").replace("\\", "/").replace('"', "'").split())


def headline(name: str, description: str) -> str:
    """The title of a robot's sources: its name and, where there is one, its description."""
    return f"{name}: {description}" if description else name


def paragraph(text: str, width: int, hanging: int = 0) -> list[str]:
    """``text`` in lines of at most ``width`` columns, those after the first indented by ``hanging``."""
    return textwrap.wrap(safe(text), width, subsequent_indent=" " * hanging, break_on_hyphens=False)


def listed(items: Iterable[str], width: int) -> list[str]:
    """Items with a comma after each, as many to a line as ``width`` columns hold."""
    lines: list[str] = []
    for item in items:
        if lines and len(lines[-1]) + len(item) + 2 <= width:
            lines[-1] += f" {item},"
        else:
            lines.append(f"{item},")
    return lines


def documented(
    function: Function, inputs: Sequence[tuple[str, Signal]], outputs: Sequence[tuple[str, Signal]], width: int
) -> tuple[str, ...]:
    """What a function's docstring says, in lines of at most ``width`` columns; inputs and outputs by their names."""
    lines = [*paragraph(function.summary, width), ""]
    if function.details:
        lines += [*paragraph(function.details, width), ""]
    for title, named in (("Inputs", inputs), ("Outputs", outputs)):
        lines.append(f"{title}:")
        for name, signal in named:
            text = paragraph(f"{name}: {described(signal)}", width - 4, hanging=4)
            lines += [f"    {line}" for line in text]
    return tuple(lines)
