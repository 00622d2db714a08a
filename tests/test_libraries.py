"""Libraries that the tests share: the same sources are compiled once, others and those for other compilers anew."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator.earlier import library_of
from tests import libraries


def test_only_what_compiles_alike_is_shared(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    compiled = []

    def build(folder: Path, name: str) -> Path:
        compiled.append(folder)
        (folder / library_of(name)).write_text((folder / "robot.c").read_text())
        return folder / library_of(name)

    monkeypatch.setattr(libraries, "build_library", build)
    (tmp_path / "kept").mkdir()
    built = libraries.built_once(tmp_path / "kept")

    def made(number: int, text: str) -> bool:
        folder = tmp_path / str(number)
        (folder / library_of("robot")).parent.mkdir(parents=True)
        (folder / "robot.c").write_text(text)
        assert built(folder, "robot").read_text().startswith("double x = ")
        return folder in compiled

    assert made(1, "double x = 1.5; /* of one file */")
    assert not made(2, "double x = 1.5; /* of another */")
    assert made(3, "double x = 1.25; /* of one file */")
    monkeypatch.setenv("CC", "another compiler")
    assert made(4, "double x = 1.5; /* of one file */")
