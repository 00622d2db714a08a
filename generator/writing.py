"""Writing a folder of files so that a reader sees the old generation or the new one, never a mixture."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from generator.errors import InputError, Place


def replace(folder: Path, files: Mapping[str, bytes]) -> None:
    """Writes ``files`` (relative path -> content) into ``folder``, all of them or none.

    Each top-level entry of ``files`` replaces the folder's entry of that name whole, so that nothing stale stays in
    it; the folder's other entries are not touched. Raises InputError where the folder cannot be written.
    """
    with replacing(folder) as fresh, _written(folder):
        for name, content in files.items():
            path = fresh / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)


@contextmanager
def replacing(folder: Path, shared: str = "") -> Iterator[Path]:
    """A fresh folder to write into; when the context ends well its entries replace those of ``folder``, all or none.

    That ``folder`` can be written is looked at first. Of its entry ``shared`` each entry is replaced by itself.
    """
    with _written(folder):
        _usable(folder)
        folder.parent.mkdir(parents=True, exist_ok=True)
        temporary = tempfile.TemporaryDirectory(prefix=f".{folder.name}-", dir=folder.parent)
    with temporary as name:
        fresh, stale = Path(name, "fresh"), Path(name, "stale")
        fresh.mkdir()
        stale.mkdir()
        yield fresh
        with _written(folder):
            folder.mkdir(exist_ok=True)
            _exchange(folder, fresh, stale, _entries(fresh, shared))


@contextmanager
def _written(folder: Path) -> Iterator[None]:
    """What fails within is told as a folder that cannot be written."""
    try:
        yield
    except OSError as error:
        raise InputError(
            Place(str(folder)), f"it cannot be written ({error.strerror})", "a folder that can be made and written"
        ) from error


def _usable(folder: Path) -> None:
    if os.path.lexists(folder):
        code = errno.EEXIST if not folder.is_dir() else 0 if os.access(folder, os.W_OK | os.X_OK) else errno.EACCES
        if code:
            raise OSError(code, os.strerror(code))


def _entries(fresh: Path, shared: str) -> list[str]:
    """Names of what is moved."""
    names = [name for name in os.listdir(fresh) if name != shared]
    if shared and (fresh / shared).is_dir():
        names += [f"{shared}/{name}" for name in os.listdir(fresh / shared)]
    return sorted(names)


def _exchange(folder: Path, fresh: Path, stale: Path, names: list[str]) -> None:
    """Moves ``names`` of ``fresh`` into ``folder`` and what they replace into ``stale``; undoes it all on failure."""
    moves: list[tuple[Path, Path]] = []
    try:
        for name in names:
            if os.path.lexists(folder / name):
                _move(folder / name, stale / name, moves)
            _move(fresh / name, folder / name, moves)
    except BaseException:
        for source, target in reversed(moves):
            target.rename(source)
        raise


def _move(source: Path, target: Path, moves: list[tuple[Path, Path]]) -> None:
    target.parent.mkdir(exist_ok=True)
    source.rename(target)
    moves.append((source, target))
