"""How the files of several runs are told apart in words."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from identification.dataset import Run
from identification.run_source import RunSource


def paths(runs: Sequence[Run]) -> list[Path]:
    """The file of each run, whole or not."""
    return [RunSource.of(run.name).path for run in runs]


def told_files(runs: Sequence[Run]) -> list[str]:
    """The name of each run's file, with as many of its folders as the files of the others leave in doubt."""
    every = paths(runs)
    return [_told(path, {*every} - {path}) for path in every]


def _told(path: Path, others: set[Path]) -> str:
    ends = (path.parts[-count:] for count in range(1, len(path.parts)))
    alone = (end for end in ends if all(other.parts[-len(end) :] != end for other in others))
    return str(Path(*next(alone, path.parts)))
