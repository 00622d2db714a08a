"""Writing a folder of files so that a reader sees the old generation or the new one, never a mixture."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from pathlib import Path

from generator.errors import InputError, Place


def replace(folder: Path, files: Mapping[str, bytes]) -> None:
    """Writes ``files`` (relative path -> content) into ``folder``, all of them or none.

    Each top-level entry of ``files`` replaces the folder's entry of that name whole, so that nothing stale stays in
    it; the folder's other entries are not touched. Raises InputError where the folder cannot be written.
    """
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f".{folder.name}-", dir=folder.parent) as temporary:
            fresh, stale = Path(temporary, "fresh"), Path(temporary, "stale")
            stale.mkdir()
            for name, content in files.items():
                path = fresh / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)
            folder.mkdir(exist_ok=True)
            _exchange(folder, fresh, stale)
    except OSError as error:
        raise InputError(
            Place(str(folder)), f"it cannot be written ({error.strerror})", "a folder that can be made and written"
        ) from error


def _exchange(folder: Path, fresh: Path, stale: Path) -> None:
    """Moves the entries of ``fresh`` into ``folder`` and what they replace into ``stale``; undoes it all on failure."""
    moves: list[tuple[Path, Path]] = []
    try:
        for name in sorted(os.listdir(fresh)):
            if os.path.lexists(folder / name):
                _move(folder / name, stale / name, moves)
            _move(fresh / name, folder / name, moves)
    except BaseException:
        for source, target in reversed(moves):
            target.rename(source)
        raise


def _move(source: Path, target: Path, moves: list[tuple[Path, Path]]) -> None:
    source.rename(target)
    moves.append((source, target))
