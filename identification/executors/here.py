"""One task after the other, in this process."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

OPTION = None
METAVAR = HELP = ""


class Here:
    """An Executor without workers."""

    def map(self, function: Callable[[Any], Any], tasks: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
        """As Executor.map."""
        for name, task in tasks.items():
            yield name, function(task)


@contextmanager
def opened(text: str) -> Iterator[Here]:
    """The executor."""
    yield Here()
