"""Gear ratios, wrist coupling and currents: Table 2 in exact rationals, the maps there and back, equal power."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy

from generator.resources import find_robot
from generator.robot.description import Drives
from generator.robot.readers import read
from tests.subject import Subject, close, subject

#: N54, N64, N65 of report Table 2.
COEFFICIENTS = {
    "kr270": (Fraction(17, 3770), Fraction(18872, 2064075), Fraction(112, 9855)),
    "kr500": (Fraction(-7, 1664), Fraction(-64055, 10497344), Fraction(230, 37851)),
}
#: N_C54, N_C64, N_C65 with the row's ratio: small fractions, as teeth make them.
BY_ROW = {
    "kr270": (Fraction(1), Fraction(-53, 37), Fraction(-265, 148)),
    "kr500": (Fraction(-53, 50), Fraction(1), Fraction(-1)),
}
#: Decimals printed in Table 2: the row's ratio made the first column, the column's ratio the second.
PRINTED = {"kr270": (1.0, -1.4, -1.8), "kr500": (-1.1, -1.6, 1.5)}
MADE_WITH = {"kr270": "row", "kr500": "as_printed"}

MAPS = (
    "motor_position",
    "joint_position",
    "motor_speed",
    "joint_speed",
    "motor_torque",
    "joint_torque",
    "motor_current",
    "joint_torque_from_current",
)


def drives(name: str, convention: str, folder: Path) -> Drives:
    """The drives of a robot file with another convention of its coupling."""
    text = find_robot(name).read_text(encoding="utf-8")
    assert text.count("convention: row") == 1
    file = folder / f"{name}.yaml"
    file.write_text(text.replace("convention: row", f"convention: {convention}"), encoding="utf-8")
    found = read(file).drives
    assert found is not None
    return found


def coupled(found: Drives) -> tuple[Fraction, Fraction, Fraction]:
    """N_C54, N_C64, N_C65."""
    N = found.coupling
    return N[4][3], N[5][3], N[5][4]


@pytest.mark.parametrize("name", COEFFICIENTS)
def test_coupling_by_the_rows_ratio_is_made_of_small_fractions(name: str, tmp_path: Path) -> None:
    found = drives(name, "row", tmp_path)
    N5, N6 = found.ratios[4:]
    N54, N64, N65 = COEFFICIENTS[name]
    assert coupled(found) == (-N54 * N5, -N6 * (N64 - N54 * N65), -N65 * N6) == BY_ROW[name]


@pytest.mark.parametrize("name", COEFFICIENTS)
def test_coupling_as_printed_uses_the_columns_ratio(name: str, tmp_path: Path) -> None:
    found = drives(name, "as_printed", tmp_path)
    N4, N5, _ = found.ratios[3:]
    N54, N64, N65 = COEFFICIENTS[name]
    assert coupled(found) == (-N54 * N4, -N4 * (N64 - N54 * N65), -N65 * N5)


@pytest.mark.parametrize("name", COEFFICIENTS)
def test_printed_decimals_come_from_two_conventions(name: str, tmp_path: Path) -> None:
    found = coupled(drives(name, MADE_WITH[name], tmp_path))
    assert tuple(round(float(entry), 1) for entry in found) == PRINTED[name]


@pytest.mark.parametrize("name", COEFFICIENTS)
def test_nothing_else_is_coupled(name: str, tmp_path: Path) -> None:
    found = drives(name, "row", tmp_path)
    below = {(4, 3), (5, 3), (5, 4)}
    for i, row in enumerate(found.coupling):
        assert row[i] == found.ratios[i]
        assert all(entry == 0 for k, entry in enumerate(row) if k != i and (i, k) not in below)


@pytest.mark.parametrize("name", COEFFICIENTS)
def test_one_coupling_coefficient_is_what_one_joint_turns_another_by(name: str, tmp_path: Path) -> None:
    # With motor 5 held, a turn of joint 4 turns joint 5 by N54; with 6 held as well, joint 6 by N64.
    N = np.array([[float(entry) for entry in row] for row in drives(name, "row", tmp_path).coupling])
    joints = np.linalg.solve(N, N[3, 3] * np.eye(6)[3])
    N54, N64, _ = COEFFICIENTS[name]
    assert close(joints, [0, 0, 0, 1, float(N54), float(N64)])


SPINDLE = """\
name: spindle
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 1, alpha: 0, d: 0, theta: 0, r: q2}
  - {j: 3, sigma: 0, alpha: pi/2, d: 0, theta: q3, r: 0}
drives:
  gear_ratios: [-100, 2*pi/0.01, 858/7]
  coupling: {convention: row, N21: 0.01/(2*pi), N32: pi/3}
  torque_constants: {unit: N m/A, use: warm, warm: [0.8, 0.5, 0.4]}
effects:
  - {effect: motor_ripple, joints: [2]}
"""


def test_the_ratio_of_a_spindle_is_exact(tmp_path: Path) -> None:
    file = tmp_path / "spindle.yaml"
    file.write_text(SPINDLE)
    robot = read(file)
    assert robot.drives is not None
    assert robot.drives.coupling == (
        (-100, 0, 0),
        (-1, 200 * sympy.pi, 0),
        (Fraction(143, 700), -286 * sympy.pi / 7, Fraction(858, 7)),
    )
    spindle = subject(robot, names=(*MAPS, "inverse_dynamics"))
    qr = np.array([-30.0, 2 * np.pi * 50 - 0.3, 0.0])
    assert close(spindle.output("joint_position", qr=qr)[:2], [0.3, 0.5], 1e-14)
    for function in spindle.model.functions:
        inputs = spindle.inputs(spindle.model.functions[function], 1)
        for name, values in spindle.expected(function, inputs).items():
            assert close(spindle.generated(function, inputs)[name], values, 1e-12)


@pytest.fixture(scope="module", params=["kr270", "kr500"])
def driven(request: pytest.FixtureRequest) -> Subject:
    """The report's robots with the maps of their drives."""
    return subject(read(find_robot(request.param)), names=MAPS)


@pytest.mark.parametrize(
    ("there", "back"),
    [
        ("motor_position", "joint_position"),
        ("joint_position", "motor_position"),
        ("motor_speed", "joint_speed"),
        ("joint_speed", "motor_speed"),
        ("motor_torque", "joint_torque"),
        ("joint_torque", "motor_torque"),
        ("motor_current", "joint_torque_from_current"),
        ("joint_torque_from_current", "motor_current"),
    ],
)
def test_maps_invert_each_other(driven: Subject, there: str, back: str) -> None:
    inputs = driven.inputs(driven.model.functions[there], 1)
    (start,) = inputs.values()
    (returned,) = driven.generated(back, driven.generated(there, inputs)).values()
    assert close(returned, start, 1e-13)
    assert not close(driven.output(there, **inputs), start, 1e-3)


def test_motors_and_joints_have_the_same_power(driven: Subject) -> None:
    qd = np.array([0.3, -0.7, 1.1, -0.4, 0.9, 0.6])
    tau = np.array([210.0, -95.0, 48.0, 31.0, -27.0, 12.0])
    rotors = driven.output("motor_torque", tau=tau) @ driven.output("motor_speed", qd=qd)
    assert close(rotors, tau @ qd, 1e-13)


def test_wrist_torques_are_those_of_equation_18(driven: Subject) -> None:
    assert driven.robot.drives is not None
    N = [float(ratio) for ratio in driven.robot.drives.ratios]
    Nc54, Nc64, Nc65 = (float(entry) for entry in BY_ROW[driven.robot.name])
    kt = [driven.values[f"kt{j}"] for j in range(1, 7)]
    current = np.array([3.0, -5.0, 7.0, 2.0, -4.0, 6.0])
    gain = [n * k for n, k in zip(N, kt, strict=True)]
    tau = [g * i for g, i in zip(gain, current, strict=True)]
    tau[3] += Nc54 / N[4] * gain[4] * current[4] + Nc64 / N[5] * gain[5] * current[5]
    tau[4] += Nc65 / N[5] * gain[5] * current[5]
    assert close(driven.output("joint_torque_from_current", current=current), tau, 1e-13)


@pytest.mark.parametrize(("name", "in_use"), [("kr270", "warm"), ("kr500", "warm")])
def test_nominal_torque_constants_are_those_in_use(name: str, in_use: str) -> None:
    arm = subject(read(find_robot(name)), names=MAPS)
    assert arm.robot.drives is not None
    nominal = dict(zip((p.name for p in arm.model.parameters), arm.model.default_parameters(), strict=True))
    constants = arm.robot.drives.torque_constants[in_use]
    assert [nominal[f"kt{j}"] for j in range(1, 7)] == [float(kt) for kt in constants]
    assert arm.robot.drives.torque_constant == in_use
