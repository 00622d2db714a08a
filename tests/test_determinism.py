"""A generation depends on the robot file and the generator's version, on nothing else, byte for byte."""

from __future__ import annotations

import gc
import shutil
from pathlib import Path

import pytest

from generator.errors import InputError
from generator.generation import generate
from generator.resources import find_robot
from tests.commands import ROOT, process, tree


@pytest.mark.parametrize(
    "name",
    [
        *(pytest.param(name, marks=pytest.mark.long) for name in ("kr270", "puma560", "tree_two_arms")),
        "tilted_two_link",
    ],
)
def test_hash_seed_folder_locale_and_time_zone_do_not_matter(name: str, tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    copy = shutil.copy(find_robot(name), elsewhere / "renamed.yaml").name
    here = {"PYTHONHASHSEED": "0", "LC_ALL": "C", "TZ": "UTC"}
    there = {"PYTHONHASHSEED": "4711", "LC_ALL": "C.UTF-8", "TZ": "Asia/Tokyo"}
    first = process("generate", name, "--out", tmp_path / "first", cwd=ROOT, **here)
    second = process("generate", copy, "--out", "second", cwd=elsewhere, **there)
    assert (first.status, second.status) == (0, 0), first.err + second.err
    files = tree(tmp_path / "first")
    assert len(files) > 10
    assert files == tree(elsewhere / "second")
    for place in (tmp_path, ROOT):
        assert not [path for path, content in files.items() if str(place).encode() in content]


@pytest.mark.parametrize("collects", [True, False])
def test_garbage_is_collected_afterwards_as_before(collects: bool, tmp_path: Path) -> None:
    (gc.enable if collects else gc.disable)()
    try:
        with pytest.raises(InputError):
            generate(tmp_path / "nothing.yaml", tmp_path / "out")
        assert gc.isenabled() == collects
    finally:
        gc.enable()
