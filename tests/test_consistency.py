"""The nearest physically consistent parameters, and the sets written into robot files."""

from __future__ import annotations

from pathlib import Path
from random import Random

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from benchmarks.nearest_consistent import BaseValues, Knowledge, nearest
from benchmarks.twins import radii_of_gyration
from generator.derivation import derive
from generator.errors import InputError
from generator.reference import sample
from generator.resources import robots
from generator.robot.description import ParameterSet, ParameterValue
from generator.robot.parameters import INERTIAL
from generator.robot.readers import read
from generator.symbolic.model import Model
from generator.symbolic.pseudo_inertia import basis, of_body, pseudo_inertia, uniform_bar
from identification.consistency import grouped
from identification.robot_file import rounded, with_parameter_set
from tests.chains import random_robot

PENDULUM = """
name: pendulum
gravity: [0 m/s2, -9.81 m/s2, 0 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}
effects:
  - {effect: rotor_inertia, joints: all}
  - {effect: viscous_friction, joints: all}
  - {effect: coulomb_friction, joints: all}
"""


@pytest.fixture(scope="module")
def pendulum(tmp_path_factory: pytest.TempPathFactory) -> Model:
    path = tmp_path_factory.mktemp("robots") / "pendulum.yaml"
    path.write_text(PENDULUM)
    return derive(read(path), names=())


BALL = {1: uniform_bar(2.0, (0, 0, 0), (1, 0, 0), 0.2)}


# -- pseudo-inertia ---------------------------------------------------------------------------------------------------


def test_pseudo_inertia_is_the_second_moment_of_points() -> None:
    draw = np.random.default_rng(1)
    points, masses = draw.normal(size=(9, 3)), draw.uniform(1, 2, 9)
    tensor = sum(m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(masses, points, strict=True))
    ten = [*tensor[np.triu_indices(3)], *(masses @ points), masses.sum()]
    homogeneous = np.hstack([points, np.ones((9, 1))])
    P = (masses[:, None] * homogeneous).T @ homogeneous
    assert np.allclose(pseudo_inertia(ten), P, rtol=1e-13)
    assert np.allclose(np.tensordot(ten, basis(), 1), P, rtol=1e-13)
    named = {f"{stem}3": value for (stem, _, _), value in zip(INERTIAL, ten, strict=True)}
    assert (of_body(3, named) == pseudo_inertia(ten)).all()


def test_uniform_bar_is_a_row_of_balls() -> None:
    start, end, radius = np.array([0.1, -0.2, 0.3]), np.array([0.5, 0.4, -0.6]), 0.25
    P = np.zeros((4, 4))
    steps = 4000
    for k in range(steps):
        r = np.append(start + (end - start) * (k + 0.5) / steps, 1.0)
        P += 3.0 / steps * (np.outer(r, r) + np.diag([radius**2 / 5] * 3 + [0]))
    assert np.allclose(uniform_bar(3.0, tuple(start), tuple(end), radius), P, atol=1e-7)


def test_radii_of_gyration_of_a_bar() -> None:
    bar = uniform_bar(3.0, (1, 2, 3), (1, 2, 5), 0.5)
    across, along = 0.5 / np.sqrt(5), np.sqrt(4 / 12 + 0.25 / 5)
    assert radii_of_gyration(bar) == pytest.approx([across, across, along])


# -- nearest ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(3))
def test_possible_parameters_are_their_own_nearest(seed: int) -> None:
    model = derive(random_robot(Random(seed)), names=(), check=False)
    drawn = sample.physical_parameters(model.robot, seed)
    truth = {parameter.name: drawn[parameter.name] for parameter in model.standard_parameters}
    base = grouped(model, truth)
    estimate = BaseValues(base, {name: 0.01 * max(abs(value), 0.1) for name, value in base.items()})
    bodies = {body.number: of_body(body.number, truth) for body in model.robot.bodies}
    found = nearest(model, estimate, Knowledge(bodies, 1.0))
    assert estimate.distance(grouped(model, found)) < 1e-4
    inertial = [f"{stem}{number}" for number in bodies for stem, _, _ in INERTIAL]
    assert [found[name] for name in inertial] == pytest.approx([truth[name] for name in inertial], rel=1e-4, abs=1e-4)


def test_impossible_estimate_moves_to_the_edge_of_the_possible(pendulum: Model) -> None:
    assert list(pendulum.grouping.numeric()) == ["ZZ1R", "MX1", "MY1", "Fv1", "Fc1"]
    estimate = BaseValues(
        {"ZZ1R": -4.0, "MX1": 3.0, "MY1": 0.0, "Fv1": -1.0, "Fc1": 2.0},
        {"ZZ1R": 2.0, "MX1": 0.1, "MY1": 0.1, "Fv1": 0.5, "Fc1": 0.5},
    )
    found = nearest(pendulum, estimate, Knowledge(BALL, 0.0, {"M1": 2.0}))
    # All mass in one point: ZZ1 = MX1^2 / M1, and the friction that would drive is none.
    expected = minimize_scalar(lambda mx: ((mx**2 / 2 + 4) / 2) ** 2 + ((mx - 3) / 0.1) ** 2, bounds=(0, 3)).x
    assert found["MX1"] == pytest.approx(expected, rel=1e-4)
    assert found["ZZ1"] == pytest.approx(expected**2 / 2, rel=1e-4)
    assert found["Ia1"] == pytest.approx(0, abs=1e-4)
    assert [found["Fv1"], found["Fc1"]] == pytest.approx([0, 2], abs=1e-6)
    shifts = estimate.shifts(grouped(pendulum, found))
    assert shifts["Fv1"] == pytest.approx(2, rel=1e-5)
    assert estimate.distance(grouped(pendulum, found)) == pytest.approx(np.linalg.norm(list(shifts.values())))


def test_weight_draws_towards_the_known_body(pendulum: Model) -> None:
    estimate = BaseValues({"ZZ1R": 5.0, "MX1": 2.0}, {"ZZ1R": 1.0, "MX1": 1.0})
    light, heavy = (nearest(pendulum, estimate, Knowledge(BALL, weight)) for weight in (1e-3, 1e3))
    assert estimate.distance(grouped(pendulum, light)) < 0.01
    assert np.allclose(of_body(1, heavy), BALL[1], atol=0.02)
    assert not np.allclose(of_body(1, light), BALL[1], atol=0.2)
    # Nothing known involves friction; only the sum ZZ1 + Ia1 is known, and the rotor takes what the body leaves.
    assert [heavy["Fv1"], heavy["Fc1"]] == pytest.approx([0, 0], abs=1e-9)
    assert heavy["Ia1"] == pytest.approx(5 - heavy["ZZ1"], rel=1e-6)


def test_given_values_are_exact_or_refused(pendulum: Model) -> None:
    estimate = BaseValues({"ZZ1R": 5.0, "MX1": 2.0}, {"ZZ1R": 1.0, "MX1": 1.0})
    found = nearest(pendulum, estimate, Knowledge(BALL, 1.0, {"MX1": 1.5, "Ia1": 0.25}))
    assert [found["MX1"], found["Ia1"]] == pytest.approx([1.5, 0.25], rel=1e-9)
    with pytest.raises(ValueError, match=r"no physically consistent parameters with \{'M1': -1.0\}"):
        nearest(pendulum, estimate, Knowledge(BALL, 1.0, {"M1": -1.0}))


# -- sets in robot files ----------------------------------------------------------------------------------------------

SET = ParameterSet(
    "fitted",
    'a description so long that it needs more than one line of a file, with a "quotation", a \\ and a colon: so',
    "made up",
    {
        "Fv1": ParameterValue(12.3456789, "N m s/rad", 1.23456, note="first"),
        "Ia1": ParameterValue(1.23456789e-5, "kg m2"),
        "ZZ1R": ParameterValue(-6.54321e7, "kg m2"),
        "MX1": ParameterValue(-3e-14, "kg m"),
    },
    {"ML": ParameterValue(5, "kg")},
)
READ_BACK = {"Fv1": 12.3457, "Ia1": 1.23457e-5, "ZZ1R": -6.54321e7, "MX1": 0.0}


def read_back(text: str, tmp_path: Path) -> ParameterSet:
    path = tmp_path / "robot.yaml"
    path.write_text(text)
    return read(path).parameter_sets["fitted"]


@pytest.mark.parametrize(
    "text",
    [
        PENDULUM,
        PENDULUM + "parameters:\n",
        PENDULUM + "parameters:  # none yet\n  other:\n    values:\n      Fv1: 1 N m s/rad\n\n# the end\nsource: me\n",
        PENDULUM + "parameters:\n  fitted:\n    values: {Fc1: 1 N m}\n  fitted_too:\n    values: {Fc1: 2 N m}\n",
        PENDULUM + "parameters:\n  first:\n    values: {Fc1: 1 N m}\n\n  fitted:\n    values: {Fc1: 2 N m}",
    ],
)
def test_set_is_written_and_read_back(text: str, tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    # An empty section is filled, and is not read.
    path.write_text(text.removesuffix("parameters:\n"))
    before = read(path).parameter_sets
    written = with_parameter_set(text, SET)
    one = read_back(written, tmp_path)
    assert {name: value.value for name, value in one.values.items()} == READ_BACK
    assert {name: value.unit for name, value in one.values.items()} == {n: v.unit for n, v in SET.values.items()}
    assert (one.values["Fv1"].relative_std, one.values["Fv1"].note, one.values["Fv1"].source) == (
        1.23,
        "first",
        "made up",
    )
    assert (one.description, one.source, one.other_values["ML"].value) == (SET.description, SET.source, 5)
    assert with_parameter_set(written, SET) == written
    others = [line for line in text.splitlines() if line and "{Fc1: 1" not in line and "{Fc1: 2" not in line]
    assert [line for line in others if line not in written.splitlines()] == []
    after = read(path).parameter_sets
    assert after.keys() == before.keys() | {"fitted"}
    for name in before.keys() - {"fitted"}:
        assert {key: one.value for key, one in after[name].values.items()} == {
            key: one.value for key, one in before[name].values.items()
        }
    assert max(map(len, written.splitlines())) <= 120


def test_a_file_of_no_break_spaces_takes_a_set(tmp_path: Path) -> None:
    text = f"{PENDULUM}parameters:\n  cad: {{values: {{Fc1: 1 N m}}}}\n".replace(" ", "\u00a0")
    written = with_parameter_set(text, SET)
    assert written.startswith(text)
    one = read_back(written, tmp_path)
    assert {name: value.value for name, value in one.values.items()} == READ_BACK
    assert with_parameter_set(written, SET) == written


@pytest.mark.parametrize("path", robots(), ids=lambda path: path.stem)
def test_the_rest_of_a_robot_file_stays(path: Path, tmp_path: Path) -> None:
    text = path.read_text()
    written = with_parameter_set(text, SET)
    start = written.index("  fitted:\n")
    assert written[:start].rstrip().removesuffix("parameters:").rstrip() in text
    kept = {name: one.values for name, one in read(path).parameter_sets.items()}
    (tmp_path / path.name).write_text(written)
    again = read(tmp_path / path.name).parameter_sets
    assert {name: {k: v.value for k, v in again[name].values.items()} for name in kept} == {
        name: {k: v.value for k, v in values.items()} for name, values in kept.items()
    }
    assert set(again) == {*kept, "fitted"}


CAD = "cad: {values: {Fc1: 3 N m}}"
JSON = """{"name": "pendulum", "gravity": ["0 m/s2", "-9.81 m/s2", "0 m/s2"],
 "joints": [{"j": 1, "sigma": 0, "alpha": 0, "d": 0, "theta": "q1", "r": 0}],
 "effects": [{"effect": "viscous_friction", "joints": "all"}, {"effect": "coulomb_friction", "joints": "all"}]"""


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("parameters:\n    cad:\n        values: {Fc1: 3 N m}\n", "\n    fitted:\n        description: "),
        (f"parameters:\n {CAD}\n\nsource: me\n", "\n\n fitted:\n  description: "),
        (f"parameters:\n    fitted:\n        values: {{Fc1: 1 N m}}\n\n    # cad\n    {CAD}\n", "\n\n    # cad\n"),
        (f'"parameters":\n    {CAD}\n    "fitted": {{values: {{Fc1: 1 N m}}}}', "\n    fitted:\n"),
        (f"parameters: # two\n  {CAD}\n  # not yet\n  # named\n# the end\nsource: me", "# named\n\n  fitted:"),
        ("parameters: {}\n", "\nparameters:\n  fitted:\n"),
        ("parameters: { }  # none yet\nsource: me\n", "\nparameters:  # none yet\n  fitted:\n"),
        ("parameters:\n  {}\n", "\nparameters:\n  fitted:\n"),
        ("parameters: {  # none yet\n}\n", "{  # none yet\n  fitted: {"),
        (f"parameters: {{{CAD}}}  # flow\n", "  }}  # flow\n"),
        (f"parameters: {{\n  {CAD},  # flow\n}}\nsource: me\n", "  },  # flow\n}\nsource: me\n"),
        (f"parameters: {{{CAD}  # flow\n}}", "  }  # flow\n}"),
        (f"parameters: {{fitted: {{values: {{Fc1: 1 N m}}}}, {CAD}}}", f"  }}, {CAD}}}\n"),
        (f"parameters:\r\n    {CAD}\r\n\r\n# the end\r\nsource: me\r\n", "\n\n# the end\nsource: me\n"),
        ("source: me\n# the end\n...\n", "# the end\n\nparameters:\n  fitted:\n"),
    ],
)  # fmt: skip
def test_a_section_keeps_its_own_layout(text: str, kept: str, tmp_path: Path) -> None:
    """Indentation, braces, comments and the other sets, whatever the file's line ends and last key."""
    text = PENDULUM + text
    written = with_parameter_set(text, SET)
    assert kept in written
    one = read_back(written, tmp_path)
    assert {name: value.value for name, value in one.values.items()} == READ_BACK
    assert (one.description, one.other_values["ML"].value) == (SET.description, 5)
    robot = read(tmp_path / "robot.yaml")
    assert list(robot.parameter_sets.keys() - {"fitted"}) == (["cad"] if "cad" in text else [])
    assert "cad" not in text or robot.parameter_sets["cad"].values["Fc1"].value == 3
    assert ("source: me" in text) == (robot.source == "me")
    assert [line for line in text.splitlines() if line.lstrip().startswith("#") and line not in written] == []
    assert with_parameter_set(written, SET) == written
    assert max(map(len, written.splitlines())) <= 120


@pytest.mark.parametrize("section", ["", ', "parameters": {}', ', "parameters": {"cad": {"values": {"Fc1": "3 N m"}}}'])
def test_a_robot_in_braces_takes_a_set(section: str, tmp_path: Path) -> None:
    written = with_parameter_set(f"{JSON}{section}}}", SET)
    assert {name: value.value for name, value in read_back(written, tmp_path).values.items()} == READ_BACK
    assert len(read(tmp_path / "robot.yaml").parameter_sets) == 1 + ("cad" in section)
    assert with_parameter_set(written, SET) == written


def test_a_set_without_values_is_read_back(tmp_path: Path) -> None:
    one = ParameterSet("fitted", "nothing known", "made up", {}, SET.other_values)
    for text in (PENDULUM, PENDULUM + f"parameters: {{{CAD}}}\n"):
        read_one = read_back(with_parameter_set(text, one), tmp_path)
        assert (read_one.values, read_one.other_values["ML"].value) == ({}, 5)


@pytest.mark.parametrize(
    ("text", "refusal"),
    [
        ("parameters: [cad]\n", "a:10:13: parameters is a list, expected a table with names as keys"),
        ("parameters: cad\n", "a:10:13: parameters is the text 'cad', expected a table with names as keys"),
        ("parameters: {cad: 1\n", "a:11:1: not YAML: "),
    ],
)
def test_a_section_that_holds_no_sets_is_refused(text: str, refusal: str) -> None:
    with pytest.raises(InputError) as refused:
        with_parameter_set(PENDULUM + text, SET, "a")
    assert str(refused.value).startswith(refusal)


@pytest.mark.parametrize(
    ("value", "expected"), [(123456.7, 123457.0), (1234567.8, 1.23457e6), (-4e-7, -4e-7), (-4e-13, 0.0), (0, 0.0)]
)
def test_rounded_is_what_is_read_back(value: float, expected: float) -> None:
    assert rounded(value) == expected
