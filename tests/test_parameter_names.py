"""Lengths may be called like anything that no language keeps for itself, macros of the generated C too."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from generator.backends import batch, c, casadi, simulation
from generator.backends.printing.c_names import taken
from generator.derivation import derive
from generator.errors import InputError
from generator.generation import generate
from generator.python_library import build_library, load_library
from generator.robot.readers import read
from tests.compiled import module

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

CAPITALS = (
    ARM.replace("name: names", "name: R2")
    + """\
  - {effect: stribeck_friction, joints: all, values: {vs: 0.1 rad/s}}
drives: {gear_ratios: [100, 100, 100]}
flexible: [2]
parameters:
  first:
    values: {Fv1: 1 N m s/rad}
"""
)


@pytest.mark.parametrize(
    "names",
    [
        ("WIDTH", "NBASE"),
        pytest.param(("RIGID_SIZE", "METHOD_RK4"), marks=pytest.mark.long),
        pytest.param(("CONTACT_FREE", "OBSERVATION_WORK"), marks=pytest.mark.long),
        pytest.param(("TILE", "H"), marks=pytest.mark.long),
    ],
)
def test_a_length_called_like_a_macro_compiles(names: tuple[str, str], tmp_path: Path) -> None:
    path = tmp_path / "names.yaml"
    path.write_text(ARM.replace("FIRST", names[0]).replace("SECOND", names[1]))
    folder, _ = generate(path, tmp_path)
    build_library(folder, "names")
    assert load_library(folder, "names")


@pytest.mark.parametrize(
    "names",
    [
        ("real", "gravity"),
        pytest.param(("prepared", "params_first"), marks=pytest.mark.long),
        pytest.param(("lanes", "rigid_state"), marks=pytest.mark.long),
    ],
)
def test_of_a_robot_in_capitals_a_length_called_like_a_type_or_function_compiles(
    names: tuple[str, str], tmp_path: Path
) -> None:
    path = tmp_path / "capitals.yaml"
    path.write_text(CAPITALS.replace("FIRST", names[0]).replace("SECOND", names[1]))
    folder, _ = generate(path, tmp_path)
    build_library(folder, "R2")
    assert load_library(folder, "R2")


def test_names_taken_by_the_c_sources_are_all_that_they_define(tmp_path: Path) -> None:
    path = tmp_path / "capitals.yaml"
    path.write_text(CAPITALS)
    model = derive(read(path))
    texts = [
        text
        for backend in (c, batch, simulation, casadi)
        for file, text in backend.emit(model).items()
        if file.endswith((".c", ".h")) and isinstance(text, str)
    ]
    code = re.sub(r'/\*.*?\*/|"[^"\n]*"', "", "\n".join(texts), flags=re.DOTALL)
    constants = {f"R2_{prefix}{one.name}" for one in model.parameters for prefix in ("", "STD_")}
    constants |= {f"R2_STD_{one.name}" for one in model.standard_parameters}
    assert set(re.findall(r"\bR2_\w+", code)) - constants <= set(taken(model))


def test_no_name_of_the_c_sources_is_taken_twice(tmp_path: Path) -> None:
    """A type called like a function of the mathematics would be its macro where both are seen."""
    path = tmp_path / "capitals.yaml"
    path.write_text(CAPITALS)
    names = list(taken(derive(read(path))))
    assert len(names) == len(set(names))


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


def test_a_length_called_like_a_parameter_of_an_effect_is_told_where_it_stands(tmp_path: Path) -> None:
    path = tmp_path / "names.yaml"
    path.write_text(ARM.replace("FIRST", "Fd1").replace("SECOND", "b"))
    path.write_text(path.read_text() + "  - {effect: dahl_friction, joint: 1, values: {xs: 1 mrad}}\n")
    with pytest.raises(InputError, match=r":4:3: length 'Fd1' has the name of a parameter of dahl_friction, expected"):
        derive(read(path))


@pytest.mark.parametrize("name", ["Fst2", "kc1", "Fp3", "Iam2", "k1", "ks3", "F01", "Fv12", "Ia1R"])
def test_no_length_has_a_name_that_an_effect_could_bring(name: str, tmp_path: Path) -> None:
    """A diagnosis may add any effect of the library to the file, which is then to be read as before."""
    path = tmp_path / "names.yaml"
    path.write_text(ARM.replace("FIRST", name).replace("SECOND", "b"))
    with pytest.raises(InputError, match=rf":4:3: length '{name}' has the name of a parameter of [a-z_]+, expected"):
        derive(read(path), ())


def test_arguments_of_casadi_functions_have_names_that_no_length_takes(tmp_path: Path) -> None:
    path = tmp_path / "names.yaml"
    values = []
    for names in (("a", "b"), ("in_q", "in_parameters")):
        path.write_text(ARM.replace("FIRST", names[0]).replace("SECOND", names[1]))
        model = derive(read(path), ["inverse_dynamics"], check=False)
        functions = module(casadi.emit(model)["names.py"], "names").functions()
        size = len(model.parameters)
        values.append(functions["inverse_dynamics"]([0.1 * k for k in range(size)], [1, 2, 3], [4, 5, 6], [7, 8, 9]))
    assert (values[0] == values[1]).full().all()
