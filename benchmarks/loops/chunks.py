"""Timing functions of many samples: chunk by chunk, in turns, on one thread or more."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

#: Samples are computed chunk by chunk, each timed, into one of PLACES places in memory in turn: a chunk's matrix is
#: larger than the last cache, and a short one is more likely to be left alone by other work on the machine.
SAMPLES, CHUNK, PLACES, PASSES = 1_000_000, 20_000, 4, 4
#: Results agree to this part of the largest entry, or the row is void.
_TOLERANCE = 1e-9

Array = NDArray[np.float64]


def signals(joints: int) -> tuple[Array, Array, Array]:
    """Random q, qd, qdd of all samples (each SAMPLES x joints)."""
    q, qd, qdd = np.random.default_rng(1).uniform(-2.0, 2.0, (3, SAMPLES, joints))
    return q, qd, qdd


def part(k: int) -> slice:
    """The samples of chunk k."""
    begin = k * CHUNK % SAMPLES
    return slice(begin, begin + CHUNK)


def chunk(all_signals: Sequence[Array], k: int) -> list[Array]:
    """Chunk k of each signal."""
    return [x[part(k)] for x in all_signals]


def aligned(size: int) -> Array:
    """Memory that has been written before and begins on a multiple of 64 bytes."""
    memory = np.ones(size + 8)
    start = -(memory.ctypes.data // 8) % 8
    return memory[start : start + size]


def agree(found: Array, wanted: Array) -> bool:
    """Whether two results agree."""
    return bool(np.abs(found - wanted).max() <= _TOLERANCE * np.abs(wanted).max())


def on_threads(count: int) -> None:
    """The number of threads of what is called next."""
    ctypes.CDLL("libgomp.so.1").omp_set_num_threads(count)


def in_turns(threads: int, calls: Mapping[str, Callable[[int], object]], passes: int = PASSES) -> dict[str, float]:
    """Nanoseconds a sample of each, the least of its calls for each chunk, which take turns."""
    taken = dict.fromkeys(calls, np.inf)
    clock = time.process_time if threads == 1 else time.perf_counter
    for k in range(passes * SAMPLES // CHUNK):
        for name, call in calls.items():
            taken[name] = min(taken[name], best(lambda call=call, k=k: call(k), 1, clock) / CHUNK)  # type: ignore[misc]
    return taken


def best(call: Callable[[], object], passes: int, clock: Callable[[], float] = time.process_time) -> float:
    """Nanoseconds of the quickest pass."""
    times = []
    for _ in range(passes):
        begin = clock()
        call()
        times.append(clock() - begin)
    return 1e9 * min(times)
