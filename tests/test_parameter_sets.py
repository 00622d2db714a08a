"""The report's parameter sets: what is printed stands in the robot files, and the twins are robots that can exist."""

from __future__ import annotations

import csv
import itertools
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.twin_recipes import RECIPES, WEIGHT, Twin
from benchmarks.twins import DOCUMENT, LARGE
from generator.derivation import derive
from generator.errors import InputError
from generator.resources import find_robot
from generator.robot import parameter_file
from generator.robot.description import ParameterValue
from generator.robot.parameters import INERTIAL
from generator.robot.readers import read
from generator.symbolic.interpret import evaluate
from generator.symbolic.parameter_sets import parameter_vector, standard_vector
from generator.symbolic.pseudo_inertia import of_body, pseudo_inertia
from identification.consistency import grouped
from tests.at_hand import TRANSCRIBED

REFERENCE = Path(__file__).parent / "reference" / "report_tables.csv"
TABLES = {
    "table7_kr270_2f.csv": ("kr270", "report_table_7"),
    "table11_kr500_2mt_idim_ls.csv": ("kr500", "report_table_11"),
    "table13_kr500_2mt_output_error.csv": ("kr500", "report_table_13"),
}
FUNCTIONS = (
    "inertia_matrix",
    "inverse_dynamics",
    "inverse_dynamics_standard",
    "balancer",
    "flexible_inverse_dynamics",
)

Row = tuple[str, float, float | None]


@cache
def twin(name: str) -> Twin:
    return Twin(derive(read(find_robot(name)), names=FUNCTIONS), RECIPES[name])


def values_of(name: str, set_name: str) -> dict[str, ParameterValue]:
    return dict(twin(name).robot.parameter_sets[set_name].values)


def numbers_of(name: str, set_name: str) -> dict[str, float]:
    return {key: one.value for key, one in values_of(name, set_name).items()}


@cache
def reference() -> dict[tuple[str, str], dict[str, Row]]:
    """Rows of the report's tables by robot and set."""
    found: dict[tuple[str, str], dict[str, Row]] = {}
    with REFERENCE.open(newline="") as file:
        for row in csv.DictReader(file):
            std = row["relative_std_percent"]
            rows = found.setdefault((row["robot"], row["set"]), {})
            rows[row["parameter"]] = (row["unit"], float(row["value"]), float(std) if std else None)
    return found


@pytest.fixture(params=sorted(RECIPES))
def robot(request: pytest.FixtureRequest) -> str:
    name: str = request.param
    return name


# -- what the report prints -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "table"), sorted(reference()))
def test_every_printed_value_stands_in_its_set(name: str, table: str) -> None:
    one = twin(name).robot.parameter_sets[table]
    given = {**one.values, **one.other_values}
    assert {key: (v.unit, v.value, v.relative_std) for key, v in given.items()} == reference()[name, table]
    number = table.removeprefix("report_table_")
    assert all(value.source.endswith(f"Table {number}") for value in given.values())
    known = {parameter.name for parameter in twin(name).model.parameters}
    assert known >= set(one.values)


def test_no_report_set_without_a_reference(robot: str) -> None:
    sets = {key for key in twin(robot).robot.parameter_sets if not key.startswith("twin")}
    assert sets == {table for name, table in reference() if name == robot}


@TRANSCRIBED.needed
@pytest.mark.parametrize("file", sorted(TABLES))
def test_reference_is_the_transcribed_table(file: str) -> None:
    with (TRANSCRIBED.path / file).open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    printed = {
        {"F0": "F02"}.get(row["parameter"], row["parameter"]): (
            row["unit"],
            float(row["estimate"]),
            float(row["relative_std_percent"]) if row["relative_std_percent"] else None,
        )
        for row in rows
    }
    assert reference()[TABLES[file]] == printed


# -- the twins can exist ----------------------------------------------------------------------------------------------


def test_twin_values_every_standard_parameter_and_torque_constant(robot: str) -> None:
    model = twin(robot).model
    units = {parameter.name: parameter.unit for parameter in (*model.standard_parameters, *model.torque_constants)}
    assert {name: value.unit for name, value in values_of(robot, "twin").items()} == units


def test_twin_bodies_are_matter(robot: str) -> None:
    values = numbers_of(robot, "twin")
    for body in twin(robot).robot.bodies:
        P = of_body(body.number, values)
        # Against the prior's, so that m and m2 can be compared: every body has at least a thousandth of its thickness.
        inverse = np.linalg.inv(np.linalg.cholesky(RECIPES[robot].bodies[body.number]))
        assert np.linalg.eigvalsh(inverse @ P @ inverse.T).min() > 1e-3
        J = np.array(
            [[values[f"{'XYZ'[min(i, k)]}{'XYZ'[max(i, k)]}{body.number}"] for k in range(3)] for i in range(3)]
        )
        principal = np.linalg.eigvalsh(J)
        assert principal[0] > 0
        assert principal[2] < principal[0] + principal[1]


def test_twin_drive_trains_and_balancers_are_passive(robot: str) -> None:
    values = numbers_of(robot, "twin")
    positive = [name for name in values if re.match(r"(Ia|Fv|Fc|F0|Kr)\d$", name)]
    assert len(positive) == 3 * 6 + 1
    assert all(values[name] > 0 for name in positive)


def dense_sample(name: str, count: int = 20_000) -> NDArray[np.float64]:
    """Joint positions within the limits: random ones, then every combination of limits."""
    limits = [(float(j.lower or 0), float(j.upper or 0)) for j in twin(name).robot.moving]
    lower, upper = np.array(limits).T
    assert (lower < upper).all()
    random = np.random.default_rng(1).uniform(lower, upper, (count, len(limits)))
    return np.vstack([random, list(itertools.product(*limits))])


def test_twin_inertia_matrix_is_positive_definite_everywhere(robot: str) -> None:
    model, values = twin(robot).model, values_of(robot, "twin")
    inputs = {"q": dense_sample(robot), "parameters": parameter_vector(model, values)}
    (M,) = evaluate(model.functions["inertia_matrix"], inputs).values()
    least = np.linalg.eigvalsh(M).min()
    lightest = min(value.value for name, value in values.items() if name.startswith("Ia"))
    # Bodies that can exist only add to the inertia of the drive trains.
    assert least > lightest


def test_twin_balancer_pulls_over_the_whole_range(robot: str) -> None:
    model = twin(robot).model
    inputs = {"q": dense_sample(robot, 500), "parameters": parameter_vector(model, values_of(robot, "twin"))}
    force = next(v for k, v in evaluate(model.functions["balancer"], inputs).items() if k.startswith("force"))
    assert force.min() > 10_000
    printed = dict(values_of(robot, RECIPES[robot].table))
    if "K02" in printed:
        inputs["parameters"] = parameter_vector(model, printed)
        force = next(v for k, v in evaluate(model.functions["balancer"], inputs).items() if k.startswith("force"))
        assert force.max() < 0


# -- the twins are what they are said to be ---------------------------------------------------------------------------


def test_base_and_standard_parameters_give_the_same_torques(robot: str) -> None:
    model, values = twin(robot).model, values_of(robot, "twin")
    q, draw = dense_sample(robot, 50), np.random.default_rng(2)
    state = {"q": q, "qd": draw.normal(size=q.shape), "qdd": draw.normal(size=q.shape)}
    by_base = {**state, "parameters": parameter_vector(model, values)}
    by_standard = {**by_base, "standard_parameters": standard_vector(model, values)}
    (tau,) = evaluate(model.functions["inverse_dynamics"], by_base).values()
    (expected,) = evaluate(model.functions["inverse_dynamics_standard"], by_standard).values()
    assert np.abs(tau - expected).max() < 1e-11 * np.abs(expected).max()


def test_recipe_gives_the_twin_that_is_written(robot: str) -> None:
    for one in (twin(robot).rigid_set, twin(robot).flexible_set):
        written = values_of(robot, one.name)
        assert list(written) == list(one.values)
        for name, value in one.values.items():
            scale = max(abs(value.value), 1.0)
            assert written[name].value == pytest.approx(value.value, abs=1e-4 * scale), name
            assert (written[name].unit, written[name].note) == (value.unit, value.note)


def cost(name: str, values: dict[str, float]) -> float:
    """Squared distance to the completed table plus the weighted divergence from the assumed bodies."""
    base = grouped(twin(name).model, values)
    total = twin(name).completed.distance(base) ** 2
    for number, prior in RECIPES[name].bodies.items():
        ratio = np.linalg.solve(prior, of_body(number, values))
        total += WEIGHT * (np.trace(ratio) - np.linalg.slogdet(ratio)[1] - 4)
    return total


def nearby(name: str, values: dict[str, float], draw: np.random.Generator) -> dict[str, float]:
    """Other consistent parameters close by: each body stretched and turned a little, each positive one scaled."""
    size = 10 ** draw.uniform(-4, -2)
    result = {key: value * (1 + size * draw.normal()) for key, value in values.items()}
    for number in RECIPES[name].bodies:
        stretch = np.eye(4) + size * draw.normal(size=(4, 4))
        P = stretch @ of_body(number, values) @ stretch.T
        units = [pseudo_inertia(unit).ravel() for unit in np.eye(10)]
        ten = np.linalg.lstsq(np.array(units).T, P.ravel(), rcond=None)[0]
        result |= {f"{stem}{number}": value for (stem, _, _), value in zip(INERTIAL, ten, strict=True)}
    heads = {base.name: base.head for base in twin(name).model.grouping.base}
    for base, value in RECIPES[name].given.items():
        result[heads[base]] += value - grouped(twin(name).model, result)[base]
    return result


def test_no_consistent_set_near_the_twin_is_better(robot: str) -> None:
    values = {name: value for name, value in numbers_of(robot, "twin").items() if not name.startswith("kt")}
    draw = np.random.default_rng(3)
    here = cost(robot, values)
    steps = [cost(robot, nearby(robot, values, draw)) - here for _ in range(300)]
    assert min(steps) > 0


def test_twin_is_little_farther_from_the_table_than_any_set_must_be(robot: str) -> None:
    distance = twin(robot).printed.distance(grouped(twin(robot).model, numbers_of(robot, "twin")))
    smallest = twin(robot).smallest_distance
    assert smallest - 1e-6 <= distance < 1.05 * smallest + 0.3


@pytest.mark.parametrize(
    ("name", "parameter", "value"),
    [("kr500", "MX2R", 1.0e3), ("kr270", "K02", -7.38e3), ("kr270", "Fc6", 3.03e2), ("kr500", "F02", 2.45e4)],
)
def test_corrected_and_assumed_values(name: str, parameter: str, value: float) -> None:
    base = grouped(twin(name).model, numbers_of(name, "twin"))
    assert base[parameter] == pytest.approx(value, rel=1e-5)


def test_friction_and_wrist_drive_trains_are_as_printed(robot: str) -> None:
    values, printed = numbers_of(robot, "twin"), twin(robot).printed.values
    alone = [name for name in printed if re.match(r"(Ia|Fv|Fc|Off|F0|Kr|K0)\d+$", name)]
    assert len(alone) > 15
    assert {name: values[name] for name in alone} == pytest.approx({name: printed[name] for name in alone}, rel=1e-5)


# -- torque constants and elastic drive trains ------------------------------------------------------------------------


def test_torque_constants_are_those_of_the_tables_torques() -> None:
    maker = [1.72, 1.72, 1.33, 1.166, 1.166, 1.166]
    assert [numbers_of("kr500", "twin")[f"kt{j}"] for j in range(1, 7)] == maker
    drives = twin("kr270").robot.drives
    assert drives is not None
    gains = [numbers_of("kr270", "twin")[f"kt{j}"] * float(ratio) for j, ratio in enumerate(drives.ratios, start=1)]
    assert gains == pytest.approx([-275, -426, -404, -298, -301, 212], rel=1e-5)


def test_flexible_twin_has_the_same_bodies_and_drive_trains(robot: str) -> None:
    rigid, flexible = numbers_of(robot, "twin"), numbers_of(robot, "twin_flexible")
    for j in range(1, 7):
        assert [flexible[f"{stem}m{j}"] for stem in ("Ia", "Fv", "Fc", "Off")] == [
            rigid[f"{stem}{j}"] for stem in ("Ia", "Fv", "Fc", "Off")
        ]
    shared = {name: value for name, value in rigid.items() if not re.match(r"(Ia|Fv|Fc|Off)\d$", name)}
    own = {name: value for name, value in flexible.items() if not re.match(r"(Iam|Fvm|Fcm|Offm|k)\d$", name)}
    assert shared == own


def test_stiffness_is_measured_or_like_the_measured(robot: str) -> None:
    recipe, flexible = RECIPES[robot], values_of(robot, "twin_flexible")
    measured = {k: v for one in recipe.stiffness for k, v in numbers_of(robot, one).items()}
    frequency = measured[f"k{recipe.like}"] / flexible[f"Iam{recipe.like}"].value
    for j in range(1, 7):
        k = flexible[f"k{j}"]
        if f"k{j}" in measured:
            assert (k.value, k.note) == (measured[f"k{j}"], "")
        else:
            assert k.value / flexible[f"Iam{j}"].value == pytest.approx(frequency, rel=5e-3)
            assert k.note.startswith("assumed")


def test_flexible_twin_held_stiff_is_the_rigid_twin(robot: str) -> None:
    model = twin(robot).model
    q, draw = dense_sample(robot, 50), np.random.default_rng(4)
    qd, qdd = draw.normal(size=q.shape), draw.normal(size=q.shape)
    rigid = {"q": q, "qd": qd, "qdd": qdd, "parameters": parameter_vector(model, values_of(robot, "twin"))}
    stacked = {name: np.hstack([rigid[name], np.zeros_like(q)]) for name in ("q", "qd", "qdd")}
    stacked["parameters"] = parameter_vector(model, values_of(robot, "twin_flexible"))
    (expected,) = evaluate(model.functions["inverse_dynamics"], rigid).values()
    motors, links = evaluate(model.functions["flexible_inverse_dynamics"], stacked).values()
    assert np.abs(motors + links - expected).max() < 1e-11 * np.abs(expected).max()


# -- what the document says -------------------------------------------------------------------------------------------


def test_documented_shifts_are_those_of_the_twin(robot: str) -> None:
    part = DOCUMENT.read_text().split(f"<!-- twin of {robot} -->")[1].split("<!-- end")[0]
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")] for line in part.splitlines() if line.startswith("| ")
    ]
    base = grouped(twin(robot).model, numbers_of(robot, "twin"))
    shifts = twin(robot).printed.shifts(base)
    assert [row[0] for row in rows[2:]] == list(base)
    for name, unit, _, _, value, shift in rows[2:]:
        assert unit == next(p.unit for p in twin(robot).model.base_parameters if p.name == name)
        assert float(value) == pytest.approx(base[name], rel=6e-4, abs=1e-5)
        if name in shifts:
            assert float(shift.split()[0]) == pytest.approx(shifts[name], abs=0.006)
            assert shift.endswith("**large**") == (abs(shifts[name]) > LARGE)
        else:
            assert shift == "-"
    assert f"{twin(robot).printed.distance(base):.2f} standard deviations" in part
    assert f"physically consistent set: {twin(robot).smallest_distance:.2f}" in part


@pytest.mark.parametrize("name", sorted(RECIPES))
def test_only_impossible_values_move_far(name: str) -> None:
    shifts = twin(name).printed.shifts(grouped(twin(name).model, numbers_of(name, "twin")))
    large = {key for key, shift in shifts.items() if abs(shift) > LARGE}
    impossible = {"XX3R", "ZZ3R", "XX4R", "XY4", "ZZ4R", "XX5R", "XY5", "XZ5", "YZ5"}
    assert large == (impossible if name == "kr500" else set())


_FOLLOWS = """\
name: follows
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: pi/2, d: 0, theta: q1, r: 0}
effects:
  - {effect: load_friction, joint: 1}
parameters:
  brief: {values: {Fl1: 0.1 1}}
  full: {values: {Fl1: {value: 0.1, unit: 1}}}
"""


def test_the_unit_of_a_pure_number_may_be_stated(tmp_path: Path) -> None:
    (tmp_path / "follows.yaml").write_text(_FOLLOWS)
    (tmp_path / "values.yaml").write_text("Fl1: 0.1 1\nFv1: 0.2\n")
    sets = read(tmp_path / "follows.yaml").parameter_sets.values()
    given = [*(one.values for one in sets), parameter_file.read(tmp_path / "values.yaml")]
    assert [(values["Fl1"].value, values["Fl1"].unit) for values in given] == 3 * [(0.1, "1")]


def test_a_value_that_single_precision_cannot_compute_with_is_refused(tmp_path: Path) -> None:
    for value in ("1e100", "1e100 N m", "{value: 1e100}"):
        (tmp_path / "values.yaml").write_text(f"Fc1: {value}\n")
        with pytest.raises(InputError, match=r"value of Fc1 is 1e\+100, expected at most 1e\+12 either way"):
            parameter_file.read(tmp_path / "values.yaml")
