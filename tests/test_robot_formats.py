"""Formats of robot files: a reader in its folder is enough for its files to be found and read."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import pytest

from generator.errors import InputError
from generator.resources import OVERRIDE, find_robot, robots
from generator.robot import readers
from generator.robot.readers import yaml
from tests.commands import PENDULUM


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder at hand and of the data, with a reader of ``.robot`` beside the others."""
    reader = ModuleType("robot")
    vars(reader).update(EXTENSIONS=(".robot",), read=yaml.read)
    monkeypatch.setattr(readers, "modules", lambda package: [reader, yaml])
    monkeypatch.setenv(OVERRIDE, str(tmp_path))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "robots").mkdir()
    return tmp_path


def test_a_file_of_a_new_format_is_found_by_its_path_and_in_the_folder_of_robots(folder: Path) -> None:
    for path in (Path("mine.robot"), folder / "robots" / "pendulum.robot", folder / "robots" / "notes.txt"):
        path.write_text(PENDULUM)
    assert readers.read(find_robot("mine.robot")).name == "pendulum"
    assert find_robot("pendulum") == folder / "robots" / "pendulum.robot"
    assert [path.name for path in robots()] == ["pendulum.robot"]
    with pytest.raises(InputError, match=r"a file ending in '.txt', expected .robot or .yaml or .yml"):
        readers.read(folder / "robots" / "notes.txt")


def test_the_readers_are_looked_up_once_for_a_folder(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in "abc":
        (folder / "robots" / f"{name}.yaml").write_text(PENDULUM)
    looked: list[ModuleType] = []
    monkeypatch.setattr(readers, "modules", lambda package: looked.append(package) or [yaml])
    assert len(robots()) == 3
    assert looked == [readers]


def test_an_ending_in_capitals_is_one(folder: Path) -> None:
    Path("MINE.YAML").write_text(PENDULUM)
    assert readers.read(find_robot("MINE.YAML")).name == "pendulum"
