"""A function of many things, in as many processes as there are cores; each result is what one process makes of it."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
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
    result: list[_Result | None] = [None] * len(items)
    with ExitStack() as stack:
        others = [stack.enter_context(_working(function, items[k::processes])) for k in range(1, processes)]
        result[::processes] = [function(one) for one in items[::processes]]
        for k, other in enumerate(others, 1):
            try:
                result[k::processes] = other.recv()
            except TimeoutError:
                # An OSError as well, which a signal's handler may raise.
                raise
            except (EOFError, OSError):
                result[k::processes] = [function(one) for one in items[k::processes]]
    return result  # type: ignore[return-value]


@contextmanager
def _working(function: Callable[[_Item], _Result], items: Sequence[_Item]) -> Iterator[Connection]:
    """A process that works on ``items``, and from where its results come; it ends with this."""
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_send, args=(here, there, function, items), daemon=True)
    # Where there is no room for another process nothing comes from it.
    with suppress(OSError):
        process.start()
    there.close()
    try:
        yield here
    finally:
        here.close()
        if process.pid is not None:
            process.terminate()
            process.join()


def _cores() -> int:
    """Processes that may run at once: one where this is itself one of several that share work."""
    if sys.platform != "linux" or multiprocessing.parent_process() is not None:
        return 1
    return len(os.sched_getaffinity(0))


def _send(here: Connection, there: Connection, function: Callable[[_Item], _Result], items: Sequence[_Item]) -> None:
    # An interruption is of whoever waits, who ends this; where that one is gone, sending fails.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    here.close()
    try:
        there.send([function(one) for one in items])
    except Exception:
        # Whoever waits meets the same error, and tells it.
        there.close()
