"""Robots under cppcheck's MISRA addon: up to minutes each, so not among the quick tests."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from generator.backends import c, simulation
from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.readers import read
from tests.compiled import write
from tests.misra import checked, documented_rules

#: Documented in prose, see docs/misra.md: names that share their first 31 characters.
LONG_NAMES = "5.1"

#: What cppcheck says of its own work, and of functions that only a user calls.
REMARKS = {"unusedFunction", "staticFunction", "checkersReport", "normalCheckLevelMaxBranches"}


@pytest.fixture(scope="module", params=["scara", pytest.param("kr500", marks=pytest.mark.long)])
def library(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """Name of a robot; its library and what stands on it, in one folder."""
    model = derive(read(find_robot(request.param)))
    return request.param, write(tmp_path_factory.mktemp("library"), {**c.emit(model), **simulation.emit(model)})


@pytest.mark.parametrize("ending", [".c", "_simulation.c"])
def test_no_rule_beyond_the_documented_ones(ending: str, library: tuple[str, Path]) -> None:
    name, folder = library
    report = checked(folder / f"{name}{ending}", f"-U{name.upper()}_USE_FLOAT", f"-D{name.upper()}_LANES=1")
    found = set(re.findall(r"\[misra-c2012-([\d.]+)\]$", report, re.MULTILINE))
    others = set(re.findall(r"\[([A-Za-z]\w+)\]$", report, re.MULTILINE)) - REMARKS
    documented = documented_rules()
    assert found
    assert found <= documented | {LONG_NAMES}
    assert not others
