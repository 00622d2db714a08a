"""The robot files that come with the project: that they say what their sources say, and nothing else changes them."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy
from scipy.spatial.transform import Rotation

from generator.effects.library import library
from generator.resources import find_robot, robots, templates
from generator.robot.description import FIXED, PRISMATIC, REVOLUTE, Robot
from generator.robot.parameters import inertial_parameters
from generator.robot.readers import read
from tests.bodies import STEMS, pseudo_inertia

NAMES = [path.stem for path in robots()]


@pytest.fixture(scope="module")
def kr500() -> Robot:
    return read(find_robot("kr500"))


@pytest.fixture(scope="module")
def kr270() -> Robot:
    return read(find_robot("kr270"))


def _lengths(robot: Robot) -> dict[str, float]:
    return {length.name: float(length.value) for length in robot.lengths}


@pytest.mark.parametrize("name", NAMES)
def test_every_file_reads_and_is_named_like_its_file(name: str) -> None:
    robot = read(find_robot(name))
    assert robot.name == name
    assert robot.description
    assert robot.source
    assert robot.gravity == (0, 0, sympy.Rational(-981, 100))
    assert robot.tool.sigma == FIXED
    assert [joint.number for joint in robot.joints] == list(range(1, len(robot.joints) + 1))
    assert all(joint.antecedent < joint.number for joint in robot.joints)
    for joint in robot.moving:
        assert (joint.lower is None) == (joint.upper is None)


def test_the_kinds_of_robots() -> None:
    found = {name: read(find_robot(name)) for name in NAMES}
    sigmas = {name: tuple(joint.sigma for joint in robot.moving) for name, robot in found.items()}
    assert sigmas["puma560"] == sigmas["kr500"] == sigmas["kr270"] == (REVOLUTE,) * 6
    assert sigmas["lbr_iiwa14"] == (REVOLUTE,) * 7
    assert [sigmas[name].index(PRISMATIC) for name in ("stanford", "scara")] == [2, 2]
    assert all(length.symbolic for length in found["puma560"].lengths)
    tree = found["tree_two_arms"]
    assert [joint.number for joint in tree.joints if joint.antecedent == 2] == [3, 6, 9]
    assert [joint.number for joint in tree.bodies if joint.sigma == FIXED] == [2]
    assert found["scara"].flexible == (1, 2, 3)


TABLE_4 = [
    ("pi", "0", "q1", "rl1"),
    ("pi/2", "d2", "q2", "0"),
    ("0", "d3", "q3 + pi/2", "0"),
    ("-pi/2", "d4", "q4", "rl4"),
    ("pi/2", "0", "q5", "0"),
    ("-pi/2", "0", "q6 - pi/2", "rl6"),
    ("0", "0", "0", "0"),
]
TABLE_5 = [
    ("pi", "0", "q1", "rl1"),
    ("0", "0", "q2", "0"),
    ("pi/2", "d3", "q3", "0"),
    ("0", "0", "q4", "0"),
    ("0", "d5", "q5 + pi/2", "0"),
    ("0", "0", "q6", "0"),
    ("-pi/2", "d7", "q7", "rl7"),
    ("0", "0", "q8", "0"),
    ("pi/2", "0", "q9", "0"),
    ("0", "0", "q10", "0"),
    ("-pi/2", "0", "q11 - pi/2", "rl11"),
    ("0", "0", "q12", "0"),
    ("0", "0", "0", "0"),
]


@pytest.mark.parametrize(
    ("name", "table"),
    [
        ("kr500", TABLE_4),
        ("kr270", TABLE_4),
        ("kr270_calibrated", TABLE_4),
        ("kr500_table5", TABLE_5),
        ("kr270_table5", TABLE_5),
    ],
)
def test_tables_4_and_5(name: str, table: list[tuple[str, str, str, str]]) -> None:
    robot = read(find_robot(name))
    printed = [tuple(str(entry) for entry in (joint.alpha, joint.d, joint.theta, joint.r)) for joint in robot.joints]
    assert printed == table
    assert [joint.sigma for joint in robot.joints] == [REVOLUTE] * (len(table) - 1) + [FIXED]
    assert robot.joints[-1].tool


def test_lengths_of_sections_2_3_2_and_2_3_3(kr500: Robot, kr270: Robot) -> None:
    assert _lengths(kr500) == {"d2": 0.5, "d3": 1.3, "d4": -0.055, "rl1": -1.045, "rl4": -1.025, "rl6": -0.29}
    assert _lengths(kr270) == {"d2": 0.35, "d3": 1.25, "d4": 0.055, "rl1": -0.75, "rl4": -1.1, "rl6": -0.23}
    renamed = {"d2": "d3", "d3": "d5", "d4": "d7", "rl1": "rl1", "rl4": "rl7", "rl6": "rl11"}
    for robot in (kr500, kr270):
        chain = read(find_robot(f"{robot.name}_table5"))
        assert _lengths(chain) == {renamed[name]: value for name, value in _lengths(robot).items()}


def test_calibrated_lengths_give_the_printed_coefficients_of_section_5_1() -> None:
    length = _lengths(read(find_robot("kr270_calibrated")))
    d2, d3, d4, r4, r6 = (length[name] for name in ("d2", "d3", "d4", "rl4", "rl6"))
    printed = {
        0.12241: d2**2,
        1.685: d2**2 + d3**2,
        1.6881: d2**2 + d3**2 + d4**2,
        1.5626: d3**2,
        1.25: d3,
        0.055187: d4,
        0.060706: -d4 * r4,
        1.207: r4**2 - d4**2,
        1.213: r4**2 + d4**2,
        2.2: -2 * r4,
        0.0529: r6**2,
        0.46: -2 * r6,
    }
    assert {value: float(f"{exact:.5g}") for value, exact in printed.items()} == {value: value for value in printed}


def test_ratios_and_couplings_of_tables_1_and_2(kr500: Robot, kr270: Robot) -> None:
    assert kr500.drives is not None
    assert kr270.drives is not None
    assert [round(float(ratio)) for ratio in kr270.drives.ratios] == [-219, -286, -270, -222, -222, 158]
    assert [round(float(ratio)) for ratio in kr500.drives.ratios] == [469, 469, 505, -261, -252, 165]
    for robot, below in (
        (kr270, (Fraction(1), Fraction(-53, 37), Fraction(-265, 148))),
        (kr500, (Fraction(-53, 50), Fraction(1), Fraction(-1))),
    ):
        assert robot.drives is not None
        N = robot.drives.coupling
        assert (N[4][3], N[5][3], N[5][4]) == below
        assert tuple(N[i][i] for i in range(6)) == robot.drives.ratios
        assert sum(element != 0 for row in N for element in row) == 9


def test_coupling_as_printed_and_direct(tmp_path: Path) -> None:
    """The values printed in Table 2 were made with the row's ratio on one robot, with the column's on the other."""
    text = find_robot("kr500").read_text()
    file = tmp_path / "kr500.yaml"
    file.write_text(text.replace("convention: row", "convention: as_printed"))
    drives = read(file).drives
    assert drives is not None
    N = drives.coupling
    assert [round(float(element), 1) for element in (N[4][3], N[5][3], N[5][4])] == [-1.1, -1.6, 1.5]
    file.write_text(text.replace("convention: row, N54: -7/1664", "convention: direct, N5_4: -7/1664"))
    drives = read(file).drives
    assert drives is not None
    assert drives.coupling[4][3:5] == (Fraction(-7, 1664), Fraction(-44096, 175))


def test_torque_constants_of_table_3(kr500: Robot, kr270: Robot) -> None:
    assert kr500.drives is not None
    assert kr270.drives is not None
    assert kr500.drives.torque_constant == kr270.drives.torque_constant == "warm"
    assert [float(kt) for kt in kr500.drives.torque_constants["warm"]] == [1.72, 1.72, 1.33, 1.166, 1.166, 1.166]
    assert [float(kt) for kt in kr500.drives.torque_constants["cold"]] == [1.88, 1.88, 1.35, 1.14, 1.14, 1.14]
    assert [float(kt) for kt in kr270.drives.torque_constants["warm"]] == [1.36, 1.36, 1.36, 1.162, 1.162, 1.162]
    assert [float(kt) for kt in kr270.drives.torque_constants["cold"]] == [1.42, 1.42, 1.42, 1.20, 1.20, 1.20]


def test_balancers_of_section_2_3_4(kr500: Robot, kr270: Robot) -> None:
    for robot, effect, values in (
        (kr500, "gas_balancer", {"d21": 0.9669, "d22": 0.2062, "phi": -1.6293, "l0": 0.5, "exponent": 1}),
        (kr270, "spring_balancer", {"d21": 0.6964, "d22": 0.1847, "phi": -1.6148}),
    ):
        (use,) = (use for use in robot.effects if use.effect.endswith("balancer"))
        assert (use.effect, use.joints) == (effect, (2,))
        assert {name: float(quantity.value) for name, quantity in use.values.items()} == values
        units = {"d21": "m", "d22": "m", "phi": "rad", "l0": "m", "exponent": "1"}
        assert all(quantity.unit == units[name] for name, quantity in use.values.items())


def test_the_balancers_pass_their_dead_centre_inside_the_limits(kr500: Robot, kr270: Robot) -> None:
    for robot, dead_centre in ((kr500, -86.65), (kr270, -87.48)):
        (phi,) = (use.values["phi"].value for use in robot.effects if "phi" in use.values)
        at = math.degrees(-math.pi - float(phi))
        assert at == pytest.approx(dead_centre, abs=0.01)
        lower, upper = robot.joints[1].lower, robot.joints[1].upper
        assert lower is not None
        assert upper is not None
        assert math.degrees(float(lower)) < at < math.degrees(float(upper))


def test_parameter_sets_of_the_report(kr500: Robot, kr270: Robot) -> None:
    sets = kr500.parameter_sets
    assert [len(sets[f"report_table_{table}"].values) for table in (11, 13, 15, 16)] == [32, 50, 3, 3]
    eleven, thirteen = sets["report_table_11"].values, sets["report_table_13"].values
    assert (eleven["ZZ1R"].value, eleven["ZZ1R"].unit, eleven["ZZ1R"].relative_std) == (7.22e3, "kg m2", 2.0)
    assert (eleven["F02"].value, eleven["F02"].unit) == (2.21e4, "N")
    assert (eleven["YZ5"].value, eleven["Fv6"].value, eleven["Fc6"].value) == (-1.62e2, 7.82e2, 1.98e2)
    assert (thirteen["F02"].value, thirteen["MY2"].value, thirteen["XZ3"].value) == (2.45e4, -3.98, 5.26e2)
    assert (thirteen["Off6"].value, thirteen["Off6"].unit, thirteen["Off6"].relative_std) == (10.1, "N m", 1.21)
    assert {name: value.value for name, value in sets["report_table_15"].values.items()} == {
        "k1": 6.21e6,
        "k2": 6.66e6,
        "k3": 3.91e6,
    }
    assert [value.value for value in sets["report_table_16"].values.values()] == [1.06, 1.466, 1.574]
    assert all(value.unit == "N m/A" for value in sets["report_table_16"].values.values())

    seven = kr270.parameter_sets["report_table_7"]
    assert len(seven.values) == 26
    assert (seven.values["Kr2"].value, seven.values["Kr2"].unit) == (3.95e4, "N/m")
    assert seven.values["K02"].value == -7.38e4
    assert "as printed" in seven.values["K02"].note
    assert seven.values["Fc6"].value == 3.03e3
    assert "as printed" in seven.values["Fc6"].note
    assert seven.other_values["ML"].value == 175
    assert seven.other_values["MZL"].value == -38.2
    gains = [seven.other_values[f"g_tau{j}"].value for j in range(1, 7)]
    assert gains == [-275, -426, -404, -298, -301, 212]
    for values in (seven.values, seven.other_values):
        assert all("Table 7" in value.source and value.place.line > 1 for value in values.values())
    assert kr270.parameter_sets["report_table_9"].values["k1"].value == 1.73e6
    assert kr270.parameter_sets["report_table_10"].values["k2"].value == 1.91e6
    assert kr270.parameter_sets["report_table_10"].other_values["Offk2"].value == 2.94e6


@pytest.mark.parametrize("name", [name for name in NAMES if "example" in read(find_robot(name)).parameter_sets])
def test_example_sets_are_complete_and_possible(name: str) -> None:
    robot = read(find_robot(name))
    values = robot.parameter_sets["example"].values
    for joint in robot.bodies:
        ten = [values[f"{stem}{joint.number}"].value for stem in STEMS]
        assert np.linalg.eigvalsh(pseudo_inertia(ten)).min() > 0
    for joint in robot.bodies:
        for parameter in inertial_parameters(joint):
            assert values[parameter.name].unit == parameter.unit
    for joint in robot.moving:
        force = "N" if joint.sigma == PRISMATIC else "N m"
        assert values[f"Fc{joint.number}"].unit == force
        assert values[f"Ia{joint.number}"].unit == ("kg" if joint.sigma == PRISMATIC else "kg m2")


def test_base_is_roll_pitch_yaw_about_fixed_axes() -> None:
    pose = np.array(read(find_robot("tilted_two_link")).base.evalf(), dtype=float)
    yaw = math.radians(25)
    turned = np.array([[math.cos(yaw), -math.sin(yaw), 0], [math.sin(yaw), math.cos(yaw), 0], [0, 0, 1]])
    upright = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    np.testing.assert_allclose(pose[:3, :3], turned @ upright, atol=1e-15)
    np.testing.assert_allclose(pose[:, 3], [0.1, -0.2, 0.5, 1], atol=1e-15)


def test_base_of_general_angles(tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    text = find_robot("tilted_two_link").read_text()
    file.write_text(text.replace("[90 deg, 0 deg, 25 deg]", "[0.3 rad, -0.5 rad, 1.1 rad]"))
    pose = np.array(read(file).base.evalf(), dtype=float)
    np.testing.assert_allclose(pose[:3, :3], Rotation.from_euler("xyz", [0.3, -0.5, 1.1]).as_matrix(), atol=1e-14)


def test_the_digest_is_of_what_the_file_says(tmp_path: Path, kr270: Robot) -> None:
    text = find_robot("kr270").read_text()
    head, _, rest = text.partition("\ngeometry:")
    geometry, _, tail = rest.partition("\n\n")
    turned = "\n".join([geometry.split("\n")[0], *reversed(geometry.split("\n")[1:])])
    same = f"# a comment\r\n{head}\ngeometry:{turned}\n\n\n{tail}".replace(
        "name: kr270\n", "name: 'kr270'   # quoted\n"
    )
    file = tmp_path / "other.yaml"
    file.write_text(same.replace("d2: 0.350 m", "d2:   0.350  m"))
    assert same != text
    other = read(file)
    assert other.digest == kr270.digest
    assert other.lengths == kr270.lengths
    file.write_text(text.replace("d2: 0.350 m", "d2: 0.351 m"))
    assert read(file).digest != kr270.digest


def test_templates_are_found_beside_the_robots() -> None:
    assert templates() == find_robot("kr500").parent.parent / "templates"


def test_the_example_of_the_documentation(tmp_path: Path) -> None:
    page = (Path(__file__).parents[1] / "docs" / "robot_file.md").read_text(encoding="utf-8")
    file = tmp_path / "two_link.yaml"
    file.write_text(page.partition("```yaml\n")[2].partition("```")[0])
    robot = read(file)
    assert robot.drives is not None
    assert robot.drives.coupling == ((100, 0), (Fraction(858, 280), Fraction(-858, 7)))
    assert robot.flexible == (1,)
    assert robot.parameter_sets["measured"].values["MX1R"].note == "with the hand taken off"
    assert [length.symbolic for length in robot.lengths] == [False, True]


def test_the_documentation_lists_every_effect_with_its_parameters_and_values() -> None:
    page = (Path(__file__).parents[1] / "docs" / "robot_file.md").read_text(encoding="utf-8")
    for effect in library().values():
        (row,) = (line for line in page.splitlines() if line.startswith(f"| `{effect.id}` |"))
        _, _, parameters, values, _ = row.split("|")
        assert re.findall(r"`(\w+)`", parameters) == [parameter.stem for parameter in effect.parameters]
        assert re.findall(r"`(\w+)`", values) == [shape.name for shape in effect.shapes]


def test_an_override_without_templates_leaves_those_of_the_checkout(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    expected = templates()
    (tmp_path / "robots").mkdir()
    monkeypatch.setenv("COUNTERPOISE_DATA", str(tmp_path))
    assert robots() == []
    assert templates() == expected
