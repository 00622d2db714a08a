"""Showing that long work goes on: a spinner on a terminal that can move its cursor, plain lines elsewhere; always on
standard error.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console


@contextmanager
def stage(text: str) -> Iterator[None]:
    """Announces a stage of the work while the body runs."""
    with stages() as announced:
        announced(text)
        yield


@contextmanager
def stages() -> Iterator[Callable[[str], None]]:
    """Gives what announces one stage of the work after the other."""
    terminal = _terminal()
    if terminal is None:
        yield lambda text: print(text, file=sys.stderr, flush=True)
        return
    from rich.markup import escape

    with terminal.status("") as shown:
        yield lambda text: shown.update(escape(text))


@contextmanager
def bar(text: str) -> Iterator[Callable[[float], None]]:
    """Announces long work and gives what is told the part that is done, from 0 to 1: a bar on a terminal."""
    terminal = _terminal()
    if terminal is None:
        print(text, file=sys.stderr, flush=True)
        yield lambda part: None
        return
    from rich.progress import Progress

    with Progress(console=terminal, transient=True) as shown:
        task = shown.add_task(text, total=1.0)
        yield lambda part: shown.update(task, completed=part)


@contextmanager
def counter(text: str) -> Iterator[Callable[[int, int], None]]:
    """Gives what is told how many tasks are done, and of how many: a bar on a terminal, else a line each time."""
    terminal = _terminal()
    if terminal is None:

        def line(done: int, total: int) -> None:
            print(f"{text}: {done} of {total} done", file=sys.stderr, flush=True)

        yield line
        return
    from rich.progress import Progress

    with Progress(console=terminal, transient=True) as shown:
        task = shown.add_task(text, total=None)
        yield lambda done, total: shown.update(task, completed=done, total=total)


def _terminal() -> Console | None:
    """The terminal of standard error; None where that is no terminal, or one that cannot move its cursor (TERM=dumb),
    on which nothing of what moves would be seen.
    """
    if not sys.stderr.isatty():
        return None
    from rich.console import Console

    console = Console(stderr=True)
    return console if console.is_interactive else None
