"""A function of many things, in as many processes as there are cores; each result is what one process makes of it."""

from __future__ import annotations

import multiprocessing
import os
import sys
from collections.abc import Callable, Sequence
from multiprocessing.connection import Connection
from typing import TypeVar

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")


def side_by_side(function: Callable[[_Item], _Result], items: Sequence[_Item]) -> list[_Result]:
    """The function's results for ``items``, in their order; it may be any function, results are pickled.

    Processes are forked where the system can, and see all that this one has made. What one of them does not bring to
    an end is done here, where errors are raised.
    """
    processes = min(_cores(), len(items))
    if processes < 2:
        return [function(one) for one in items]
    context = multiprocessing.get_context("fork")
    started = []
    for first in range(1, processes):
        ours, theirs = context.Pipe(duplex=False)
        process = context.Process(target=_send, args=(theirs, function, items[first::processes]), daemon=True)
        process.start()
        theirs.close()
        started.append((first, ours, process))
    result: list[_Result | None] = [None] * len(items)
    result[::processes] = [function(one) for one in items[::processes]]
    for first, ours, process in started:
        try:
            share = ours.recv()
        except EOFError:
            share = [function(one) for one in items[first::processes]]
        process.join()
        ours.close()
        result[first::processes] = share
    return result  # type: ignore[return-value]


def _cores() -> int:
    """Processes that may run at once: one in a process that is started by another one's sharing."""
    if sys.platform != "linux" or multiprocessing.current_process().daemon:
        return 1
    return len(os.sched_getaffinity(0))


def _send(there: Connection, function: Callable[[_Item], _Result], items: Sequence[_Item]) -> None:
    try:
        there.send([function(one) for one in items])
    except Exception:
        # Whoever waits meets the same error, and tells it.
        there.close()
