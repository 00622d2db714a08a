"""A generation on disk is the old one or the new one, never a mixture."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from generator.errors import InputError
from generator.writing import replace, replacing
from tests.commands import tree


def generation(**files: bytes) -> dict[str, bytes]:
    """Files, ``__`` for a slash and ``_`` for a dot, with their manifest."""
    named = {name.replace("__", "/").replace("_", "."): content for name, content in files.items()}
    manifest = {"generator": "counterpoise", "files": sorted(named)}
    return named | {"manifest.json": json.dumps(manifest).encode()}


OLD = generation(c__robot_c=b"old", c__stale_c=b"stale")
NEW = generation(c__robot_c=b"new", review__page_html=b"new")

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


def test_somebodys_own_files_stay_beside_the_generated_ones(tmp_path: Path) -> None:
    robot = tmp_path / "robot"
    own = {"c/main.c": b"mine", "c/build/main.o": b"mine", "batch/notes.txt": b"mine"}
    made = {"python/librobot.so": b"compiled", "numpy/__init__.py": b"mine"}
    older = generation(c__robot_c=b"old", c__stale_c=b"stale", batch__robot_c=b"old", simulation__robot_c=b"old")
    replace(robot, older)
    for name, content in (own | made).items():
        (robot / name).parent.mkdir(parents=True, exist_ok=True)
        (robot / name).write_bytes(content)
    replace(robot, NEW)
    assert tree(robot) == NEW | own | {"numpy/__init__.py": b"mine"}
    assert not (robot / "simulation").exists()
    assert not (robot / "python").exists()


@pytest.mark.parametrize("manifest", ["", "[]", '{"files": ["c/main.c"]}', '{"generator": "", "files": 3}'])
def test_without_a_generations_manifest_all_files_are_somebodys_own(tmp_path: Path, manifest: str) -> None:
    (tmp_path / "c").mkdir()
    (tmp_path / "c" / "main.c").write_bytes(b"mine")
    (tmp_path / "manifest.json").write_text(manifest)
    replace(tmp_path, NEW)
    assert tree(tmp_path) == NEW | {"c/main.c": b"mine"}


def test_a_manifest_names_nothing_outside_of_its_folder(tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_bytes(b"mine")
    (tmp_path / "robot").mkdir()
    outside = ["../mine.txt", str(tmp_path / "mine.txt"), "", ".", 3]
    (tmp_path / "robot" / "manifest.json").write_text(json.dumps({"generator": "counterpoise", "files": outside}))
    replace(tmp_path / "robot", NEW)
    assert tree(tmp_path) == {f"robot/{name}": content for name, content in NEW.items()} | {"mine.txt": b"mine"}


def test_a_folder_in_the_place_of_a_file_is_refused(tmp_path: Path) -> None:
    mine = tmp_path / "c" / "robot.c" / "mine.txt"
    mine.parent.mkdir(parents=True)
    mine.write_bytes(b"mine")
    with pytest.raises(InputError, match=r"it cannot be written \(c/robot.c: Is a directory\)"):
        replace(tmp_path, NEW)
    assert tree(tmp_path) == {"c/robot.c/mine.txt": b"mine"}


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
    mine, new = ({f"code/mine/{name}": content for name, content in one.items()} for one in (OLD, NEW))
    other = {f"code/other/{name}": content for name, content in OLD.items()}
    replace(tmp_path / "out", mine | other | {"page.html": b"old"})
    with replacing(tmp_path / "out", "code") as fresh:
        replace(fresh, new | {"page.html": b"new"})
    assert tree(tmp_path / "out") == new | other | {"page.html": b"new"}


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
