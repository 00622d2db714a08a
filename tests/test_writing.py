"""A generation on disk is the old one or the new one, never a mixture."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from generator.errors import InputError
from generator.writing import replace, replacing
from tests.commands import tree

OLD = {"c/robot.c": b"old", "c/stale.c": b"stale", "manifest.json": b"old"}
NEW = {"c/robot.c": b"new", "review/page.html": b"new", "manifest.json": b"new"}

#: In memory on many machines, and so on another file system than other folders.
MEMORY = Path("/dev/shm")


@pytest.fixture
def elsewhere(tmp_path: Path) -> Iterator[Path]:
    """A folder on another file system."""
    if not MEMORY.is_dir() or not os.access(MEMORY, os.W_OK) or MEMORY.stat().st_dev == tmp_path.stat().st_dev:
        pytest.skip("no second file system")
    with tempfile.TemporaryDirectory(dir=MEMORY) as name:
        yield Path(name)


def test_a_new_folder_holds_the_files(tmp_path: Path) -> None:
    replace(tmp_path / "deep" / "robot", NEW)
    assert tree(tmp_path) == {f"deep/robot/{name}": content for name, content in NEW.items()}


def test_stale_files_go_and_foreign_ones_stay(tmp_path: Path) -> None:
    replace(tmp_path / "robot", OLD)
    (tmp_path / "robot" / "notes").mkdir()
    (tmp_path / "robot" / "notes" / "mine.txt").write_bytes(b"mine")
    replace(tmp_path / "robot", NEW)
    assert tree(tmp_path / "robot") == NEW | {"notes/mine.txt": b"mine"}


def test_what_is_gone_goes_with_the_others(tmp_path: Path) -> None:
    replace(tmp_path / "robot", OLD | {"batch/old.c": b"old"})
    replace(tmp_path / "robot", NEW, gone=("batch", "simulation"))
    assert tree(tmp_path / "robot") == NEW


@pytest.mark.parametrize("failing", range(5))
def test_a_failure_at_any_move_restores_the_old_generation(
    tmp_path: Path, failing: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    replace(tmp_path / "robot", OLD)
    rename, moves = Path.rename, iter(range(100))

    def breaking(source: Path, target: Path) -> Path:
        if next(moves) == failing:
            raise PermissionError(13, "Permission denied")
        return rename(source, target)

    monkeypatch.setattr(Path, "rename", breaking)
    with pytest.raises(InputError, match=r"robot:1:1: it cannot be written \(Permission denied\), expected a folder"):
        replace(tmp_path / "robot", NEW)
    assert next(moves) > failing
    assert tree(tmp_path) == {f"robot/{name}": content for name, content in OLD.items()}


def test_an_interruption_restores_the_old_generation(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    replace(tmp_path / "robot", OLD)
    rename, moves = Path.rename, iter(range(100))

    def interrupted(source: Path, target: Path) -> Path:
        if next(moves) == 2:
            raise KeyboardInterrupt
        return rename(source, target)

    monkeypatch.setattr(Path, "rename", interrupted)
    with pytest.raises(KeyboardInterrupt):
        replace(tmp_path / "robot", NEW)
    assert tree(tmp_path) == {f"robot/{name}": content for name, content in OLD.items()}


def test_of_a_shared_entry_each_entry_is_replaced_by_itself(tmp_path: Path) -> None:
    old = {"code/mine/stale.c": b"stale", "code/other/robot.c": b"other", "page.html": b"old"}
    replace(tmp_path / "out", old)
    with replacing(tmp_path / "out", "code") as fresh:
        replace(fresh, {"code/mine/robot.c": b"new", "page.html": b"new"})
    kept = {"code/mine/robot.c": b"new", "code/other/robot.c": b"other", "page.html": b"new"}
    assert tree(tmp_path / "out") == kept


def test_work_that_fails_leaves_nothing(tmp_path: Path) -> None:
    def work() -> None:
        with replacing(tmp_path / "out") as fresh:
            (fresh / "robot.c").write_bytes(b"new")
            raise OSError(2, "of the work")

    with pytest.raises(OSError, match="of the work"):
        work()
    assert tree(tmp_path) == {}
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_is_refused_before_the_work(tmp_path: Path) -> None:
    (tmp_path / "out").write_bytes(b"a file")
    for folder in (tmp_path / "out", tmp_path / "out" / "deep"):
        with pytest.raises(InputError, match="it cannot be written"), replacing(folder):
            pytest.fail("the work began")
    assert tree(tmp_path) == {"out": b"a file"}


def test_a_link_to_another_file_system_is_written_through(tmp_path: Path, elsewhere: Path) -> None:
    link = tmp_path / "out"
    link.symlink_to(elsewhere)
    replace(link, OLD | {"notes.txt": b"mine"})
    replace(link, NEW)
    assert link.is_symlink()
    assert tree(elsewhere) == NEW | {"notes.txt": b"mine"}
    assert sorted(path.name for path in elsewhere.iterdir()) == ["c", "manifest.json", "notes.txt", "review"]
    assert list(tmp_path.iterdir()) == [link]


def test_of_a_folder_that_is_there_only_itself_is_written(tmp_path: Path) -> None:
    """Its parent may be on another file system, or not the user's."""
    out = tmp_path / "out"
    replace(out, OLD)
    before = tmp_path.stat().st_mtime_ns
    with replacing(out) as fresh:
        replace(fresh, NEW)
        assert list(tmp_path.iterdir()) == [out]
        assert {name: content for name, content in tree(out).items() if not name.startswith(".out-")} == OLD
    assert tree(out) == NEW
    assert tmp_path.stat().st_mtime_ns == before
    assert sorted(path.name for path in out.iterdir()) == ["c", "manifest.json", "review"]


def test_work_that_fails_leaves_the_folder_as_it_was(tmp_path: Path) -> None:
    out = tmp_path / "out"
    replace(out, OLD)

    def work() -> None:
        with replacing(out) as fresh:
            (fresh / "manifest.json").write_bytes(b"new")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        work()
    assert tree(tmp_path) == {f"out/{name}": content for name, content in OLD.items()}
    assert sorted(path.name for path in out.iterdir()) == ["c", "manifest.json"]


def test_a_folder_without_permission_is_refused_before_the_work(tmp_path: Path) -> None:
    out = tmp_path / "out"
    replace(out, OLD)
    out.chmod(0o500)
    if os.access(out, os.W_OK):
        pytest.skip("root may write anywhere")
    with pytest.raises(InputError, match=r"it cannot be written \(Permission denied\)"), replacing(out):
        pytest.fail("the work began")
    out.chmod(0o700)
    assert tree(out) == OLD
    tmp_path.chmod(0o500)
    replace(out, NEW)
    tmp_path.chmod(0o700)
    assert tree(out) == NEW


def test_a_shared_entry_that_cannot_be_is_refused_before_the_work(tmp_path: Path, elsewhere: Path) -> None:
    out = tmp_path / "out"
    replace(out, {"a_file": b"a file"})
    (out / "linked").symlink_to(elsewhere)
    for shared, told in (("a_file", "File exists"), ("linked", "Invalid cross-device link")):
        refusal = rf"out/{shared}:1:1: it cannot be written \({told}\), expected a folder"
        with pytest.raises(InputError, match=refusal), replacing(out, shared):
            pytest.fail("the work began")
    assert tree(out) == {"a_file": b"a file"}
