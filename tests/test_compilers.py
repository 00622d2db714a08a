"""Compilers that cannot make a robot's library: each is told by its own words."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator.errors import InputError
from generator.python_library import build_library
from generator.robot.readers import read
from tests.commands import PENDULUM
from tests.library_folder import folder_of
from tests.subject import subject


def test_a_compiler_that_is_missing_or_fails_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "pendulum.yaml"
    file.write_text(PENDULUM)
    arm = subject(read(file))
    folder = folder_of(arm, tmp_path / "out")
    # In the encoding of a locale of its own.
    other = tmp_path / "cc"
    other.write_text("#!/bin/sh\nprintf '\\351chec, error: x'\nexit 1\n")
    other.chmod(0o755)
    for compiler, message in (
        ("/no/such/cc", "there is no such program"),
        ("false", "it cannot be compiled"),
        ("true", "it cannot be compiled"),
        (str(other), r"it cannot be compiled \(.*chec, error: x\)"),
    ):
        monkeypatch.setenv("CC", compiler)
        with pytest.raises(InputError, match=message):
            build_library(folder, "pendulum")
