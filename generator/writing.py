"""Writing a folder of files: all of the new generation or, where anything fails, all of the old one.

Files are renamed one by one; who reads while that lasts may see some of both.
"""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from generator.earlier import MANIFEST, left_in
from generator.errors import InputError, Place


def replace(folder: Path, files: Mapping[str, bytes]) -> None:
    """Writes ``files`` (relative path -> content) into ``folder``, all of them or none.

    With a manifest among them, the other files of the generation that it replaces go; somebody's own files in the
    folder are not touched. Raises InputError where the folder cannot be written.
    """
    with replacing(folder) as fresh, _written(folder):
        for name, content in files.items():
            path = fresh / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)


def writable(folder: Path) -> None:
    """Raises InputError where ``folder`` is none that can be made and written; nothing is made."""
    there = next(one for one in (folder.absolute(), *folder.absolute().parents) if os.path.lexists(one))
    code = 0
    if not there.is_dir():
        code = errno.EEXIST
    elif not os.access(there, os.W_OK | os.X_OK):
        code = errno.EACCES
    if code:
        hint = f"; {there.name} is a file" if there.is_file() else ""
        expected = f"a folder that can be made and written{hint}"
        raise InputError(Place(str(folder)), f"it cannot be written ({os.strerror(code)})", expected)


def spare(source: Path, targets: Iterable[Path]) -> None:
    """Raises InputError where one of ``targets``, which are to be written, is the file ``source`` that was read."""
    for target in targets:
        if os.path.exists(target) and os.path.samefile(source, target):
            raise InputError(Place(str(target)), f"it would be written over {source}, which is read", "another --out")


@contextmanager
def replacing(folder: Path, shared: str = "") -> Iterator[Path]:
    """A fresh folder to write into; when the context ends well its files replace those of ``folder``, all or none.

    Where there is a manifest among them, what the generation of an earlier one left goes with them. That ``folder``
    and its entry ``shared``, which others write into too, can be written is tried first. Until then all of it is in a
    hidden folder: in ``folder``, where that is there, else beside it.
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
            left = _left(folder, fresh)
            _exchange(folder, fresh, stale, sorted({*_files(fresh), *left}))
            _tidy(folder, left)


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


def _files(fresh: Path) -> list[str]:
    return [str(path.relative_to(fresh)) for path in fresh.rglob("*") if not path.is_dir()]


def _left(folder: Path, fresh: Path) -> set[str]:
    """The files that earlier generations left where there is a fresh one."""
    generated = [path.parent.relative_to(fresh) for path in fresh.rglob(MANIFEST)]
    left = {str(one / name) for one in generated for name in left_in(folder / one)}
    return {name for name in left if not (folder / name).is_dir()}


def _exchange(folder: Path, fresh: Path, stale: Path, names: list[str]) -> None:
    """Moves the files ``names`` of ``folder`` into ``stale`` and those of ``fresh`` in their place; undoes it all on
    failure.
    """
    moves: list[tuple[Path, Path]] = []
    made: list[Path] = []
    try:
        for name in names:
            if (folder / name).is_dir() and not (folder / name).is_symlink():
                raise IsADirectoryError(errno.EISDIR, f"{name}: {os.strerror(errno.EISDIR)}")
            if os.path.lexists(folder / name):
                _move(folder / name, stale / name, moves, made)
            if os.path.lexists(fresh / name):
                _move(fresh / name, folder / name, moves, made)
    except BaseException:
        for source, target in reversed(moves):
            target.rename(source)
        for one in reversed(made):
            with suppress(OSError):
                one.rmdir()
        raise


def _move(source: Path, target: Path, moves: list[tuple[Path, Path]], made: list[Path]) -> None:
    absent = [one for one in target.parents if not one.exists()]
    for one in reversed(absent):
        one.mkdir()
        made.append(one)
    source.rename(target)
    moves.append((source, target))


def _tidy(folder: Path, left: Iterable[str]) -> None:
    """Removes the folders in ``folder`` that held nothing but what an earlier generation ``left``."""
    within = {one for name in left for one in Path(name).parents if one.parts}
    for one in sorted(within, key=lambda one: len(one.parts), reverse=True):
        with suppress(OSError):
            (folder / one).rmdir()
