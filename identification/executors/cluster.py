"""Tasks on a dask cluster, by the address of its scheduler; workers need this package and a C compiler."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from generator.command_line import command_line
from generator.errors import InputError
from identification.extras import needing

OPTION = "--scheduler"
METAVAR = "ADDRESS"
HELP = "scheduler of a dask cluster that does the work, such as tcp://10.0.0.1:8786"

#: Seconds in which the scheduler must answer.
_ANSWER = 10


class Cluster:
    """An Executor on the cluster of a distributed.Client; tasks of a worker that dies go to another one."""

    def __init__(self, client: Any) -> None:
        self._client = client

    def map(self, function: Callable[[Any], Any], tasks: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
        """As Executor.map; raises InputError where a task takes several workers with it, or the cluster is lost."""
        distributed: Any = importlib.import_module("distributed")
        # Tasks hold all that they need: data put on one worker would be lost with it.
        futures = {self._client.submit(function, task, pure=False): name for name, task in tasks.items()}
        try:
            # In this client's loop: the default is that of the process's default client, which need not be there.
            for future in distributed.as_completed(list(futures), loop=self._client.loop):
                yield futures[future], future.result()
        except distributed.KilledWorker:
            problem = "a task has ended several workers"
            raise InputError(command_line(OPTION), problem, "workers with memory and a C compiler") from None
        except distributed.CancelledError:
            problem = "the cluster is lost"
            raise InputError(command_line(OPTION), problem, "a scheduler that answers until all is done") from None
        finally:
            self._client.cancel(list(futures))


@contextmanager
def opened(text: str) -> Iterator[Cluster]:
    """The executor; raises InputError where nothing answers at the address, or dask is not installed."""
    with needing(command_line(OPTION), "cluster"):
        distributed: Any = importlib.import_module("distributed")
    try:
        client = distributed.Client(text, timeout=_ANSWER, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(command_line(OPTION), f"{text!r}: {reason}", "the address of a dask scheduler") from None
    with client:
        yield Cluster(client)
