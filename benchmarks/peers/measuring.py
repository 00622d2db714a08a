"""Running the libraries in one process: their times, and what they compute."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.callgrind import collected
from benchmarks.compiling import C, compiled, compilers, run
from benchmarks.peers.library import SOURCES, Library
from benchmarks.peers.subject import FUNCTIONS, STATES, Array, Chain, write

#: Each function is timed so often, in turn with all others; a time is that of a pass over all states.
ROUNDS = 1000

_OUTPUTS = "outputs.bin"


@dataclass(frozen=True)
class Timed:
    """A function of a library: median time of a call and the quartiles around it [ns], its results at all states."""

    library: Library
    function: str
    time: float
    quartiles: tuple[float, float]
    results: Array


def measure(subject: Chain, libraries: Sequence[Library], folder: Path, rounds: int = ROUNDS) -> list[Timed]:
    """Every function of every library, interleaved. Without rounds nothing is timed, and times are NaN."""
    entries = [(library, function) for library in libraries for function in FUNCTIONS if function in library.functions]
    printed = run(_called(subject, entries, folder, rounds))
    times = [[float(word) for word in line.split()] for line in printed.splitlines()] or [[np.nan] * 3] * len(entries)
    results = _split(np.fromfile(folder / _OUTPUTS), subject, entries)
    return [
        Timed(library, function, median, (low, high), values)
        for (library, function), (low, median, high), values in zip(entries, times, results, strict=True)
    ]


def instructions(subject: Chain, library: Library, function: str, folder: Path) -> float:
    """Instructions of a call by callgrind, what it calls included, mean of all states; raises Missing without it."""
    return collected(function, _called(subject, [(library, function)], folder, rounds=0)) / STATES


def disagreement(subject: Chain, a: Timed, b: Timed) -> float:
    """The largest difference of two results, relative to the largest entry at the same state.

    A regressor in base parameters becomes one of the bodies' standard parameters where the other is one.
    """
    first, second = a.results, b.results
    if a.function == "regressor" and a.library.standard != b.library.standard:
        first = first if a.library.standard else first @ subject.grouping
        second = second if b.library.standard else second @ subject.grouping
    axes = tuple(range(1, first.ndim))
    worst = np.abs(first - second).max(axis=axes) / np.abs(first).max(axis=axes)
    return float(np.nan_to_num(worst, nan=np.inf).max())


def _split(numbers: Array, subject: Chain, entries: Sequence[tuple[Library, str]]) -> Iterator[Array]:
    begin = 0
    for library, function in entries:
        end = begin + STATES * library.size(function, subject)
        yield library.results(function, subject, numbers[begin:end])
        begin = end


def _called(subject: Chain, entries: Sequence[tuple[Library, str]], folder: Path, rounds: int) -> Sequence[str | Path]:
    """The harness' command for functions of libraries; its files go to ``folder``."""
    lines = (
        f"{function}\t{library.size(function, subject)}\t{library.path.resolve()}\t{library.data.resolve()}\n"
        for library, function in entries
    )
    plan, states = folder / "plan.txt", write(subject.states, folder / "states.bin")
    plan.write_text("".join(lines))
    harness = compiled(compilers()[0], C, folder.parent / "harness", [SOURCES / "harness.c"], ["-ldl"])
    return [harness, states, str(subject.dof), str(rounds), folder / _OUTPUTS, plan]
