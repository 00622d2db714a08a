"""Lengths may be called like anything that no language keeps for itself, macros of the generated C too."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator.generation import generate
from generator.python_library import build_library, load_library

ARM = """\
name: names
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
geometry:
  FIRST: {nominal: 0.3 m, symbolic: true}
  SECOND: {nominal: 0.4 m, symbolic: true}
joints:
  - {j: 1, sigma: 0, alpha: pi/2, d: 0, theta: q1, r: FIRST}
  - {j: 2, sigma: 0, alpha: 0, d: SECOND, theta: q2, r: 0}
  - {j: 3, sigma: 0, alpha: pi/2, d: FIRST, theta: q3, r: SECOND}
effects:
  - {effect: viscous_friction, joints: all}
  - {effect: coulomb_friction, joints: all}
"""


@pytest.mark.parametrize(
    "names",
    [
        ("WIDTH", "NBASE"),
        pytest.param(("RIGID_SIZE", "METHOD_RK4"), marks=pytest.mark.long),
        pytest.param(("CONTACT_FREE", "OBSERVATION_WORK"), marks=pytest.mark.long),
        ("TILE", "H"),
    ],
)
def test_a_length_called_like_a_macro_compiles(names: tuple[str, str], tmp_path: Path) -> None:
    path = tmp_path / "names.yaml"
    path.write_text(ARM.replace("FIRST", names[0]).replace("SECOND", names[1]))
    folder, _ = generate(path, tmp_path)
    build_library(folder, "names")
    assert load_library(folder, "names")


def test_what_an_older_generation_had_and_a_new_one_has_not_is_gone(tmp_path: Path) -> None:
    """An effect with a state has no functions of many samples; the older ones would not fit the header."""
    path = tmp_path / "names.yaml"
    path.write_text(ARM.replace("FIRST", "a").replace("SECOND", "b"))
    folder, _ = generate(path, tmp_path)
    assert (folder / "batch").is_dir()
    path.write_text(path.read_text() + "  - {effect: dahl_friction, joint: 1, values: {xs: 1 mrad}}\n")
    generate(path, tmp_path)
    assert not (folder / "batch").exists()
    assert not (folder / "simulation").exists()
    build_library(folder, "names")
