"""Writing a folder of files so that a reader sees the old generation or the new one, never a mixture."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from generator.errors import InputError, Place


def replace(folder: Path, files: Mapping[str, bytes], gone: Collection[str] = ()) -> None:
    """Writes ``files`` (relative path -> content) into ``folder``, all of them or none.

    Each top-level entry of ``files`` replaces the folder's entry of that name whole, so that nothing stale stays in
    it; entries that are ``gone`` go, and the folder's other ones are not touched. Raises InputError where the folder
    cannot be written.
    """
    with replacing(folder, gone=gone) as fresh, _written(folder):
        for name, content in files.items():
            path = fresh / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)


def spare(source: Path, targets: Iterable[Path]) -> None:
    """Raises InputError where one of ``targets``, which are to be written, is the file ``source`` that was read."""
    for target in targets:
        if os.path.exists(target) and os.path.samefile(source, target):
            raise InputError(Place(str(target)), f"it would be written over {source}, which is read", "another --out")


@contextmanager
def replacing(folder: Path, shared: str = "", gone: Collection[str] = ()) -> Iterator[Path]:
    """A fresh folder to write into; when the context ends well its entries replace those of ``folder``, all or none.

    That ``folder`` can be written is tried first. Of its entry ``shared`` each entry is replaced by itself; those that
    are ``gone`` go with the others. Until then all of it is in a hidden folder: in ``folder``, where that is there,
    else beside it.
    """
    with _written(folder / shared):
        _check_shared(folder, shared)
    with _written(folder):
        temporary = tempfile.TemporaryDirectory(prefix=f".{folder.name}-", dir=_beside(folder))
    with temporary as name:
        fresh, stale = Path(name, "fresh"), Path(name, "stale")
        with _written(folder):
            fresh.mkdir()
            stale.mkdir()
        yield fresh
        with _written(folder):
            folder.mkdir(exist_ok=True)
            _exchange(folder, fresh, stale, sorted({*_entries(fresh, shared), *gone}))


@contextmanager
def _written(folder: Path) -> Iterator[None]:
    """What fails within is told as a folder that cannot be written."""
    try:
        yield
    except OSError as error:
        raise InputError(
            Place(str(folder)), f"it cannot be written ({error.strerror})", "a folder that can be made and written"
        ) from error


def _beside(folder: Path) -> Path:
    """Where what becomes part of ``folder`` can wait; it has to be on the same file system to be moved."""
    if folder.is_dir():
        # Its parent may be on another one, where the folder is a link or a mount point, or may not be written.
        return folder
    if os.path.lexists(folder):
        raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST))
    folder.parent.mkdir(parents=True, exist_ok=True)
    return folder.parent


def _check_shared(folder: Path, shared: str) -> None:
    """Refuses an entry ``shared`` into which nothing of the folder can be moved at the end."""
    entry = folder / shared
    if not shared or not os.path.lexists(entry):
        return
    code = 0
    if not entry.is_dir():
        code = errno.EEXIST
    elif not os.access(entry, os.W_OK | os.X_OK):
        code = errno.EACCES
    elif entry.stat().st_dev != folder.stat().st_dev:
        code = errno.EXDEV
    if code:
        raise OSError(code, os.strerror(code))


def _entries(fresh: Path, shared: str) -> list[str]:
    """Names of what is moved."""
    names = [name for name in os.listdir(fresh) if name != shared]
    if shared and (fresh / shared).is_dir():
        names += [f"{shared}/{name}" for name in os.listdir(fresh / shared)]
    return sorted(names)


def _exchange(folder: Path, fresh: Path, stale: Path, names: list[str]) -> None:
    """Moves ``names`` of ``folder`` into ``stale`` and those of ``fresh`` in their place; undoes it all on failure."""
    moves: list[tuple[Path, Path]] = []
    try:
        for name in names:
            if os.path.lexists(folder / name):
                _move(folder / name, stale / name, moves)
            if os.path.lexists(fresh / name):
                _move(fresh / name, folder / name, moves)
    except BaseException:
        for source, target in reversed(moves):
            target.rename(source)
        raise


def _move(source: Path, target: Path, moves: list[tuple[Path, Path]]) -> None:
    target.parent.mkdir(exist_ok=True)
    source.rename(target)
    moves.append((source, target))
