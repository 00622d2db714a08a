"""Tasks in processes of this machine."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import Any

from generator.command_line import command_line
from generator.errors import InputError

OPTION = "--workers"
METAVAR = "N"
HELP = "processes of this machine that share the work"

#: How often in a row processes may die before a task is done.
_DEATHS = 3


class Processes:
    """An Executor of ``workers`` processes, made anew where one dies."""

    def __init__(self, workers: int) -> None:
        self._workers = workers

    def map(self, function: Callable[[Any], Any], tasks: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
        """As Executor.map; raises InputError where processes die again and again."""
        left, deaths = dict(tasks), 0
        while left:
            # Started afresh, not forked: threads of compiled libraries do not survive a fork.
            context = multiprocessing.get_context("spawn")
            with ProcessPoolExecutor(min(self._workers, len(left)), mp_context=context) as pool:
                try:
                    names = {pool.submit(function, task): name for name, task in left.items()}
                    for future in as_completed(names):
                        result = future.result()
                        del left[names[future]]
                        deaths = 0
                        yield names[future], result
                except BrokenProcessPool:
                    deaths += 1
                finally:
                    pool.shutdown(wait=False, cancel_futures=True)
            if deaths > _DEATHS:
                raise InputError(command_line(OPTION), "processes die before any task is done", "memory for them all")


@contextmanager
def opened(text: str) -> Iterator[Processes]:
    """The executor; raises InputError for what is no number of processes."""
    if not text.isdecimal() or not 1 <= int(text) <= 1024:
        raise InputError(command_line(OPTION), repr(text), "a whole number from 1 to 1024")
    yield Processes(int(text))
