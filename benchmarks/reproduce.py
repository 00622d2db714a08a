"""Plays sections 5 and 6 of the report on the twins: ``python -m benchmarks.reproduce [seeds=N] [only=NAME...]``.

Writes ``benchmarks/reproduction.json`` and the tables of ``docs/reproduction.md``. Each experiment is played with N
draws of its noise (100) in as many processes as there are processors; ``only`` plays some and keeps the other results.
"""

from __future__ import annotations

import importlib
import os
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import benchmarks.reproduction.experiments
from benchmarks.reproduction import page
from benchmarks.reproduction.coverage import coverage, share
from benchmarks.reproduction.experiment import Experiment, Found
from benchmarks.reproduction.results import FILE, Results, read, write
from generator.discovery import modules
from generator.errors import InputError, Place

_SEEDS = 100
_FOLDER = benchmarks.reproduction.experiments.__name__


def main(words: Sequence[str]) -> int:
    """Plays, prints and writes; returns the exit status."""
    known = [module.__name__.rpartition(".")[2] for module in modules(benchmarks.reproduction.experiments)]
    try:
        seeds, names = _asked(words, known)
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    workers = max(os.cpu_count() or 1, 1)
    new = {}
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        parts = {name: [pool.submit(played, name, range(seeds)[k::workers]) for k in range(workers)] for name in names}
        for name in names:
            new[name] = _summary([one.result() for one in parts[name]])
            _tell(name, new[name])
    every = {**(read().experiments if FILE.exists() else {}), **new}
    results = Results({name: every[name] for name in known if name in every})
    write(results)
    if lacking := [name for name in known if name not in every]:
        print(f"the page waits for {', '.join(lacking)}")
    else:
        page.write(results)
    return 0


def played(name: str, seeds: Sequence[int]) -> list[Found]:
    """What an experiment finds for some seeds."""
    experiment: Experiment = importlib.import_module(f"{_FOLDER}.{name}")  # type: ignore[assignment]
    with tempfile.TemporaryDirectory(prefix="counterpoise-") as folder:
        return list(experiment.play(seeds, Path(folder)))


def _summary(parts: Sequence[Sequence[Found]]) -> dict[str, Any]:
    """For the results file; the first part begins with the first draw."""
    everything = [one for part in parts for one in part]
    return {"draws": len(everything), "first": parts[0][0].as_json(), "coverage": coverage(everything)}


def _tell(name: str, result: dict[str, Any]) -> None:
    shares = ", ".join(f"{model} {share(one):.1f} %" for model, one in result["coverage"].items())
    print(f"{name}: true value within two standard deviations: {shares}", flush=True)


def _asked(words: Sequence[str], known: Sequence[str]) -> tuple[int, list[str]]:
    """The number of draws, and the experiments to play."""
    seeds, names = str(_SEEDS), ""
    for word in words:
        key, _, value = word.partition("=")
        if key == "seeds":
            seeds = value
        else:
            names = f"{names} {value if key == 'only' else word}"
    if not seeds.isdecimal() or int(seeds) < (os.cpu_count() or 1):
        raise InputError(Place("seeds"), f"{seeds!r}", "a number of draws, one a processor at least")
    chosen = names.replace(",", " ").split() or list(known)
    for name in chosen:
        if name not in known:
            place = Place("benchmarks/reproduction/experiments")
            raise InputError(place, f"there is no experiment {name!r}", f"one of {', '.join(known)}")
    return int(seeds), chosen


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
