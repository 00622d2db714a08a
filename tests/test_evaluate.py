"""``counterpoise evaluate``: its numbers against hand calculation and the independent reference, and its refusals."""

from __future__ import annotations

import json
from math import cos, pi, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from generator.derivation import derive
from generator.reference.quantities import Reference
from generator.reference.sample import physical_parameters, positions
from generator.resources import find_robot
from generator.robot.readers import read
from tests.commands import PENDULUM, command, process

STATE = ("--q", "0.3", "--qd", "-2", "--qdd", "1.5")


def printed(*arguments: str | Path, capsys: pytest.CaptureFixture[str]) -> Any:
    done = command("evaluate", *arguments, capsys=capsys)
    assert (done.status, done.err) == (0, "")
    return json.loads(done.out)


def refusal(*arguments: str | Path, capsys: pytest.CaptureFixture[str]) -> str:
    done = command("evaluate", *arguments, capsys=capsys)
    assert (done.status, done.out) == (2, "")
    assert done.err.count("\n") == 1
    return done.err


# -- numbers ------------------------------------------------------------------------------------------------------


def test_inverse_dynamics_of_a_pendulum_by_hand(pendulum: Path, capsys: pytest.CaptureFixture[str]) -> None:
    result = printed(pendulum, "inverse_dynamics", *STATE, "--parameters", "light", capsys=capsys)
    by_hand = 2 * 1.5 + 0.25 * -2 - 0.125 + 9.81 * (3 * cos(0.3) - 0.5 * sin(0.3))
    assert result == {"tau": [pytest.approx(by_hand, rel=1e-14)]}


@pytest.mark.parametrize("numbers", [["-1e-3"], ["=-1e-3"], ["=-0.001,"], ["-1/1000"]])
def test_negative_numbers_in_every_notation(
    pendulum: Path, numbers: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    given = [f"--q{numbers[0]}"] if numbers[0].startswith("=") else ["--q", *numbers]
    result = printed(pendulum, "gravity", *given, "--parameters=light", capsys=capsys)
    assert result == {"Q": [pytest.approx(9.81 * (3 * cos(-1e-3) - 0.5 * sin(-1e-3)), rel=1e-14)]}


def test_expressions_of_pi_and_commas(capsys: pytest.CaptureFixture[str]) -> None:
    one = printed("kr500", "tool_transform", "--q", "0, -pi/4", "0.2 0", "0", "pi", capsys=capsys)
    two = printed("kr500", "tool_transform", "--q", "0", str(-pi / 4), "0.2", "0", "0", str(pi), capsys=capsys)
    assert np.array(one["T"]).shape == (4, 4)
    np.testing.assert_allclose(one["T"], two["T"], atol=1e-14)


@pytest.mark.parametrize(
    ("name", "quantity"),
    [
        ("kr500", "inverse_dynamics"),
        ("kr270", "inverse_dynamics_standard"),
        pytest.param("kr500", "inertia_matrix", marks=pytest.mark.long),
        ("puma560", "direct_dynamics"),
        ("scara", "flexible_inverse_dynamics"),
        pytest.param("kr270", "kinetic_energy", marks=pytest.mark.long),
        ("kr500", "joint_torque_from_current"),
    ],
)
def test_a_file_of_standard_parameters_against_the_reference(
    name: str, quantity: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    robot = read(find_robot(name))
    model = derive(robot, names=(quantity,), check=False)
    values = physical_parameters(robot, 3)
    inputs: dict[str, list[float]] = {}
    for signal in model.functions[quantity].inputs:
        if signal.name == "standard_parameters":
            inputs[signal.name] = [values.get(parameter.name, 0.0) for parameter in model.standard_parameters]
        elif signal.name == "q":
            inputs[signal.name] = [*positions(robot, 7), *[0.01] * (signal.size - len(robot.moving))]
        else:
            inputs[signal.name] = [0.3 * (-1) ** k + 0.1 * k for k in range(signal.size)]
    given = [
        word
        for signal, numbers in inputs.items()
        if signal != "standard_parameters"
        for word in (f"--{signal}", *map(repr, numbers))
    ]
    file = tmp_path / "standard.json"
    file.write_text(json.dumps(values))
    result = printed(name, quantity, *given, "--parameters", file, capsys=capsys)
    expected = Reference(robot, values)(quantity, inputs)
    assert result.keys() == expected.keys()
    for output, value in expected.items():
        np.testing.assert_allclose(result[output], value, rtol=1e-9, atol=1e-9 * np.abs(value).max())


def test_base_and_standard_parameters_of_one_robot_agree(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    robot = read(find_robot("kr270"))
    model = derive(robot, names=(), check=False)
    standard = {p.name: physical_parameters(robot, 5)[p.name] for p in model.standard_parameters}
    (tmp_path / "standard.yaml").write_text(json.dumps(standard))
    base = printed("kr270", "base_parameters", "--parameters", tmp_path / "standard.yaml", capsys=capsys)
    names = [parameter.name for parameter in model.base_parameters]
    (tmp_path / "base.json").write_text(json.dumps(dict(zip(names, base["base_parameters"], strict=True))))
    state = ("--q", *"123456", "--qd", *"654321", "--qdd", *"111222")
    by_file = [
        printed("kr270", "inverse_dynamics", *state, "--parameters", tmp_path / file, capsys=capsys)["tau"]
        for file in ("standard.yaml", "base.json")
    ]
    np.testing.assert_allclose(by_file[0], by_file[1], rtol=1e-12)


def test_what_a_set_lacks_is_zero_and_lengths_are_the_robots_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "short.json").write_text('{"Fv2": {"value": 2, "unit": "N m s/rad"}, "kt1": 5}')
    zeros = ("--q", *"000000", "--qdd", *"000000", "--qd", *"010000")
    result = printed("kr500", "inverse_dynamics", *zeros, "--parameters", tmp_path / "short.json", capsys=capsys)
    assert result == {"tau": [0, 2, 0, 0, 0, 0]}
    turn = ("--current", *"110000", "--parameters", tmp_path / "short.json")
    tau = printed("kr500", "joint_torque_from_current", *turn, capsys=capsys)["tau"]
    assert tau[:2] == [pytest.approx(3755 / 8 * 5), pytest.approx(3755 / 8 * 1.72)]


def test_a_set_can_move_symbolic_lengths(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    robot = read(find_robot("puma560"))
    nominal = {length.name: float(length.value) for length in robot.lengths if length.symbolic}
    values = physical_parameters(robot, 2) | {name: 1.5 * value for name, value in nominal.items()}
    (tmp_path / "moved.json").write_text(json.dumps(values))
    q = [0.1, -0.2, 0.3, -0.4, 0.5, -0.6]
    result = printed("puma560", "gravity", "--q", *map(str, q), "--parameters", tmp_path / "moved.json", capsys=capsys)
    np.testing.assert_allclose(result["Q"], Reference(robot, values)("gravity", {"q": q})["Q"], atol=1e-10)
    unmoved = Reference(robot, values | nominal)("gravity", {"q": q})["Q"]
    assert np.abs(result["Q"] - unmoved).max() > 1


def test_wrench_and_payload_are_zero_unless_given(pendulum: Path, capsys: pytest.CaptureFixture[str]) -> None:
    free = printed(pendulum, "inverse_dynamics", *STATE, "--parameters", "light", capsys=capsys)
    loaded = (pendulum, "inverse_dynamics_loaded", *STATE, "--parameters", "light")
    assert printed(*loaded, capsys=capsys)["tau"] == pytest.approx(free["tau"], rel=1e-14)
    turned = printed(*loaded, "--wrench", *"000007", capsys=capsys)["tau"]
    assert turned == [pytest.approx(free["tau"][0] + 7, rel=1e-14)]
    heavy = printed(*loaded, "--payload", *"0000002002", capsys=capsys)["tau"]
    assert heavy == [pytest.approx(free["tau"][0] + 9.81 * 2 * cos(0.3), rel=1e-14)]


def test_help_of_a_quantity_lists_its_inputs(capsys: pytest.CaptureFixture[str]) -> None:
    text = command("evaluate", "scara", "inverse_dynamics", "--help", capsys=capsys).out
    assert "  --q: 4 numbers in rad, rad, m, rad (joint positions)\n" in text
    assert "  prints tau [4]: " in text
    assert command("evaluate", "scara", "inverse_dynamics", "-h", capsys=capsys).out == text


def test_a_parameter_file_with_values_that_no_robot_has_is_told(
    pendulum: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pendulum.write_text(f"{PENDULUM}drives: {{gear_ratios: [50], torque_constants: {{unit: N m/A, use: a, a: [1]}}}}\n")
    values = pendulum.with_name("values.yaml")
    for kt, given in (("-3", True), ("0", True), ("0.5", False)):
        values.write_text(f"kt1: {kt}\nMX1: -1\n")
        done = command("evaluate", pendulum, "gravity", "--q", "0", "--parameters", values, capsys=capsys)
        assert json.loads(done.out) == {"Q": [pytest.approx(-9.81)]}
        assert done.err == (f"note: {values}:1:1: kt1 is {kt}, which no robot can have\n" if given else "")


def test_evaluating_does_not_import_casadi() -> None:
    done = process("evaluate", "kr500", "tool_transform", "--q", *"000000", PYTHONPROFILEIMPORTTIME="1")
    assert done.status == 0
    assert "sympy" in done.err
    assert "casadi" not in done.err


# -- refusals -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["gravty", "--q", "0"], ":1:1: pendulum has no quantity 'gravty', expected perhaps 'gravity'"),
        (["balancer", "--q", "0"], ":1:1: pendulum has no quantity 'balancer', expected "),
        (["gravity", "--parameters", "light"], ":1:1: --q is missing, expected 1 number in rad (joint positions)"),
        (["gravity", "--q", "0", "1"], " --q:1:1: 2 numbers, expected 1 number in rad (joint positions)"),
        (["gravity", "--q"], " --q:1:1: 0 numbers, expected 1 number in rad (joint positions)"),
        (["gravity", "--q", "0", "x"], " --q:1:3: 'x' is not a number, expected "),
        (["gravity", "--q", "inf"], " --q:1:1: 'inf' is not a finite number, expected a finite number"),
        (["gravity", "--q", "__import__('os')"], " --q:1:1: a call of '__import__', expected "),
        (["gravity", "--q", "0", "--q", "1"], " --q:1:1: the option is given twice, expected it once"),
        (["gravity", "--qd", "0"], " --qd:1:1: gravity has no such input, expected perhaps 'q'"),
        (["gravity", "0"], ":1:1: unexpected word '0', expected --SIGNAL NUMBER ..."),
        (["gravity", "--q", "0"], ":1:1: --parameters is missing, expected light or the path of a JSON or YAML file"),
        (
            ["gravity", "--q", "0", "--parameters", "ligt"],
            " --parameters:1:1: there is no parameter set and no file 'ligt', expected light or the path of",
        ),
    ],
)
def test_refused(pendulum: Path, arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    if "--parameters" not in arguments and "missing" not in message:
        arguments = [*arguments, "--parameters", "light"]
    assert refusal(pendulum, *arguments, capsys=capsys).startswith(f"error: counterpoise evaluate{message}")


def test_a_balancer_that_is_grouped_with_the_bodies_has_no_force(
    pendulum: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A spring from a point above the axis acts like the weight of the link."""
    use = "  - {effect: spring_balancer, joint: 1, values: {d21: 0.3 m, d22: 80 mm, phi: 90 deg}}\n"
    pendulum.write_text(PENDULUM.split("parameters:")[0] + use)
    told = "pendulum has no quantity 'balancer': Kr1 is grouped into MX1R, expected "
    assert told in refusal(pendulum, "balancer", "--q", "0", capsys=capsys)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('{"ZZ1": 1,\n "ZZ11": 2}', ":2:2: the robot has no parameter 'ZZ11', expected perhaps 'ZZ1'"),
        ('{"ZZ1": {"value": 1, "unit": "kg"}}', ":1:2: ZZ1 is given in kg, expected kg m2"),
        ('{"ZZ1": {"value": 1, "unit": "stone"}}', ":1:30: unknown unit 'stone', expected "),
        ('{"ZZ1": {"unit": "kg m2"}}', ":1:9: value of ZZ1 has no key 'value', expected the keys value"),
        ('{"ZZ1": "heavy"}', ":1:10: 'heavy' is not a number, expected "),
        ('{"ZZ1": NaN}', ":1:9: 'NaN' is not a finite number, expected a finite number"),
        ('{"ZZ1": {"value": 1, "relative_std": NaN}}', ":1:38: 'NaN' is not a finite number, expected a finite number"),
        ('{"ZZ1": {"value": 1, "unit": "kg m2", "note": [1]}}', ":1:47: note on ZZ1 is a list, expected a text"),
        ("[1, 2]", ":1:1: the parameter file is a list, expected a table with names as keys"),
        ('{"ZZ1": 1', ":1:10: not YAML: "),
    ],
)
def test_refused_files(
    pendulum: Path, tmp_path: Path, text: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "set.json"
    file.write_text(text)
    got = refusal(pendulum, "gravity", "--q", "0", "--parameters", file, capsys=capsys)
    assert got.startswith(f"error: {file}{message}")


OTHER_GROUPINGS = "a set of another geometry has other groupings, counterpoise review tells those of this file"


def test_base_beside_standard_parameters_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "mixed.yaml"
    file.write_text("ZZ1R: 1\nFv1: 2\nM2: 3\n")
    got = refusal("kr500", "gravity", "--q", *"000000", "--parameters", file, capsys=capsys)
    beside = "the standard parameter M2 beside the base parameter ZZ1R"
    assert got == f"error: {file}:3:1: {beside}, expected parameters of one kind\n"
    file.write_text("ZZ1R: 1\nFv1: 2\nZZ2: 3\n")
    got = refusal("kr500", "gravity", "--q", *"000000", "--parameters", file, capsys=capsys)
    assert got.endswith(f"expected parameters of one kind; {OTHER_GROUPINGS}\n")


def test_a_name_of_other_groupings_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "older.yaml"
    file.write_text("XX1R: 1\n")
    got = refusal("kr500", "gravity", "--q", *"000000", "--parameters", file, capsys=capsys)
    expected = f"expected 'XX1', which is another sum; {OTHER_GROUPINGS}"
    assert got == f"error: {file}:1:1: the robot has no parameter 'XX1R', {expected}\n"


def test_standard_parameters_cannot_come_from_base_ones(capsys: pytest.CaptureFixture[str]) -> None:
    got = refusal("kr500", "base_parameters", "--parameters", "report_table_13", capsys=capsys)
    assert "is a base parameter, expected standard parameters alone\n" in got
    assert got.startswith(f"error: {find_robot('kr500')}:")


def test_a_result_that_is_not_finite_is_refused(
    pendulum: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "none.json").write_text("{}")
    state = ("--q", "0", "--qd", "0", "--tau", "1", "--parameters", tmp_path / "none.json")
    assert refusal(pendulum, "direct_dynamics", *state, capsys=capsys) == (
        "error: counterpoise evaluate:1:1: qdd is not finite here, expected a state and parameters where it is\n"
    )
