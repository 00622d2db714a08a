"""A parameter set built into the equations: the same numbers as the parameter vector gives, by fewer operations."""

from __future__ import annotations

import json
import re
import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.backends import c
from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.content import robot_from
from generator.robot.readers import read, yaml
from generator.symbolic.built_in import built_in
from generator.symbolic.function import PARAMETERS
from generator.symbolic.interpret import evaluate
from generator.symbolic.parameter_sets import parameter_vector
from tests.commands import PENDULUM, command
from tests.conftest import derived

#: Multiplications, additions and divisions of the inverse dynamics with Table 11's essential parameters, without the
#: balancer, and with it.
AT_MOST, WITH_BALANCER = 280, 288


@pytest.mark.parametrize(
    ("robot", "parameter_set"),
    [
        ("kr500", "report_table_11"),
        pytest.param("kr500", "twin_flexible", marks=pytest.mark.long),
        pytest.param("kr270", "report_table_7", marks=pytest.mark.long),
        pytest.param("kr270", "twin", marks=pytest.mark.long),
    ],
)
def test_built_in_values_give_what_the_parameter_vector_gives(robot: str, parameter_set: str) -> None:
    described = read(find_robot(robot))
    names = ["inverse_dynamics", "inertia_matrix", "bias", "gravity", "motor_current", "flexible_direct_dynamics"]
    open_model = derive(described, names, check=False)
    built_in = derive(described, names, check=False, parameter_set=parameter_set)
    assert built_in.parameters == ()
    assert ("flexible_direct_dynamics" in built_in.functions) == (parameter_set == "twin_flexible")
    vector = parameter_vector(open_model, described.parameter_sets[parameter_set].values)
    random = np.random.default_rng(3)
    for name, function in built_in.functions.items():
        inputs = {signal.name: random.uniform(-2.0, 2.0, (20, signal.size)) for signal in function.inputs}
        expected = evaluate(open_model.functions[name], {**inputs, PARAMETERS: vector})
        for output, value in evaluate(function, {**inputs, PARAMETERS: np.zeros(0)}).items():
            tolerance = 1e-9 if function.solves else 1e-12
            np.testing.assert_allclose(value, expected[output], rtol=0, atol=tolerance * np.abs(expected[output]).max())


def test_the_header_names_the_functions_without_a_result_where_no_body_has_an_inertia() -> None:
    """And nothing to carry: as with a set of drive constants alone."""
    model = derived("kr500").model
    vector = parameter_vector(model, model.robot.parameter_sets["report_table_15"].values)
    random = np.random.default_rng(5)
    without = set()
    for name, function in model.functions.items():
        inputs = {signal.name: random.uniform(-1.0, 1.0, (4, signal.size)) for signal in function.inputs}
        inputs |= {"payload": np.zeros((4, 10))} if "payload" in inputs else {}
        with np.errstate(all="ignore"):
            found = evaluate(function, {**inputs, PARAMETERS: vector})
        if not all(np.isfinite(value).all() for value in found.values()):
            without.add(name)
    header = str(c.library(model, ())["kr500.h"]).replace("\n * ", " ")
    said = header[: header.index("solve with the inertias")].rpartition("/**")[2]
    assert set(re.findall(r"kr500_(\w+)\(\)", said)) == without


def test_the_source_says_how_the_equations_of_the_bodies_are_written() -> None:
    model = derive(read(find_robot("kr500")), names=("gravity",))
    source = " ".join(str(c.library(model, ())["kr500.c"]).split())
    assert model.strategies.choices is not None
    for kind, choice in model.strategies.choices.items():
        assert f"{kind}: {choice.way}" in source.replace("* ", "")


def test_essential_parameters_make_short_equations() -> None:
    robot = read(find_robot("kr500"))
    freely = replace(robot, effects=tuple(use for use in robot.effects if use.effect != "gas_balancer"))
    given = freely.parameter_sets["report_table_11"]
    values = {name: value for name, value in given.values.items() if name != "F02"}
    freely = replace(freely, parameter_sets={given.name: replace(given, values=values)})
    for described, most in ((freely, AT_MOST), (robot, WITH_BALANCER)):
        model = derive(described, ["inverse_dynamics"], check=False, parameter_set="report_table_11")
        assert model.functions["inverse_dynamics"].count.total <= most


def test_the_library_goes_to_its_own_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "pendulum.yaml").write_text(PENDULUM)
    done = command(
        "generate", tmp_path / "pendulum.yaml", "--build-in", "light", "--self-test", "--out", tmp_path, capsys=capsys
    )
    assert done.status == 0
    folder = tmp_path / "pendulum_light"
    manifest = json.loads((folder / "manifest.json").read_text())
    assert manifest["built_in"]["Fv1"] == 0.25
    assert manifest["parameters"] == []
    assert "void pendulum_light_inverse_dynamics(" in (folder / "c" / "pendulum_light.h").read_text()
    assert "R(0.25)" in (folder / "c" / "pendulum_light.c").read_text()
    order = [one.name for one in derive(read(tmp_path / "pendulum.yaml"), (), check=False).base_parameters]
    assert f" * {' '.join(order)}\n" in (folder / "c" / "pendulum_light.h").read_text()
    modules = [runpy.run_path(str(folder / name / "pendulum_light.py")) for name in ("numpy", "casadi")]
    assert [[*one["BASE_PARAMETERS"]] for one in modules] == [order, order]
    assert f"BASE_PARAMETERS = (\n    {', '.join(map(repr, order))},\n)" in (
        folder / "python" / "pendulum_light.py"
    ).read_text().replace('"', "'")
    assert "| Fv1 | 0.25 | N m s/rad |" in (folder / "review" / "groupings.md").read_text()


_DRIVE = "drives: {gear_ratios: [50], torque_constants: {unit: N m/A, use: a, a: [1]}}\n"


@pytest.mark.parametrize(
    ("text", "parameter_set", "expected"),
    [
        (PENDULUM, "heavy", "pendulum.yaml, expected one of light"),
        (PENDULUM.split("parameters:")[0], "light", "pendulum.yaml, expected a robot with parameter sets"),
        (PENDULUM, "heavy", "error: --build-in:1:1: no parameter set 'heavy' in "),
        (
            PENDULUM.replace("light:", "no_:"),
            "no_",
            "--build-in:1:1: robot name 'pendulum_no_' makes names that are reserved in C++, expected no _ at the end",
        ),
        (
            PENDULUM.replace("name: pendulum", "name: size").replace("light:", "t:"),
            "t",
            "--build-in:1:1: robot name 'size_t' is a name of the C library, expected another name",
        ),
        (PENDULUM.replace("      ZZ1: 2 kg m2\n", ""), "light", "divides by a parameter that is zero"),
        (
            f"{PENDULUM}      Fv3: 1 N m s/rad\n",
            "light",
            "pendulum.yaml:18:7: the robot has no parameter 'Fv3', expected perhaps 'Fv1'",
        ),
        (
            f"{PENDULUM}      kt1: 0 N m/A\n{_DRIVE}",
            "light",
            "pendulum.yaml:18:7: the torque constant kt1 of the set light is zero, expected one that a torque can be",
        ),
    ],
)
def test_sets_that_cannot_be_built_in(
    text: str, parameter_set: str, expected: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "pendulum.yaml").write_text(text)
    done = command(
        "generate", tmp_path / "pendulum.yaml", "--build-in", parameter_set, "--out", tmp_path, capsys=capsys
    )
    assert (done.status, done.out) == (2, "")
    assert expected in done.err.splitlines()[-1]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["pendulum.yaml"]


def test_joints_without_a_stiffness_are_rigid_also_where_the_file_gives_them_a_gap() -> None:
    robot = robot_from(yaml.read(_ELASTIC, "x"))
    assert built_in(robot, "one").elastic == (0,)
    assert built_in(robot, "none").elastic == ()


_ELASTIC = """\
name: two
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: pi/2, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 0, alpha: 0, d: 0.5 m, theta: q2, r: 0}
effects:
  - {effect: rotor_inertia, joints: all}
  - {effect: joint_elasticity, joint: 2, values: {gap: 1 mrad}}
flexible: all
parameters:
  one: {values: {k1: 1e4 N m/rad, Iam1: 1 kg m2, Iam2: 1 kg m2, ZZ2: 1 kg m2}}
  none: {values: {ZZ2: 1 kg m2}}
"""


def test_a_header_without_parameters_asks_for_none(tmp_path: Path) -> None:
    (tmp_path / "pendulum.yaml").write_text(PENDULUM)
    described = read(tmp_path / "pendulum.yaml")
    name = next(iter(described.parameter_sets))
    told = "all parameters are numbers in the code", "Number of base parameters; all of them are numbers in the code."
    asked = "Use: fill in", "the first of the parameters"
    for parameter_set, there, absent in ((name, told, asked), (None, asked, told)):
        model = derive(described, ["gravity"], check=False, parameter_set=parameter_set)
        header = next(str(text) for path, text in c.library(model, ()).items() if path.endswith(".h"))
        assert all(words in header for words in there)
        assert not any(words in header for words in absent)


def test_a_robot_without_a_description_is_titled_by_its_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "pendulum.yaml"
    path.write_text(PENDULUM.replace("description: one link on a horizontal axis\n", ""))
    assert built_in(read(path), "light").robot.description == "parameter set light built in"
    done = command("generate", path, "--out", tmp_path, capsys=capsys)
    assert done.out.startswith("pendulum\nbase parameters")
