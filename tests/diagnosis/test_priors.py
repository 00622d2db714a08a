"""What is known of a robot's parameters, carried over to its base parameters."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.errors import InputError
from generator.robot.readers import read
from identification.diagnosis.columns.normal_equations import Prior
from identification.diagnosis.columns.priors import notes_of, prior_of
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NOTHING
from identification.diagnosis.runs.stated_elasticity import stated
from identification.observation import Motion, Regressors
from tests.diagnosis import diagnosed_arm
from tests.diagnosis.diagnosed_arm import TRUTH, answered, torque
from tests.newton_euler import Arm
from tests.recorded import TWO_LINKS, UNITS, parameters_text, recorded

Array = NDArray[np.float64]

#: Values with relative standard deviations [%]; None where the file tells none.
VALUES: dict[str, tuple[float, str, float | None]] = {
    "XX1": (2.0, "kg m2", 10), "YY1": (3.0, "kg m2", 5), "ZZ1": (4.0, "kg m2", 8), "MX1": (6.0, "kg m", 4),
    "MY1": (1.5, "kg m", 12), "MZ1": (0.7, "kg m", 20), "M1": (30.0, "kg", 3), "Ia1": (5.0, "kg m2", 6),
    "XX2": (0.9, "kg m2", 9), "YY2": (1.1, "kg m2", 7), "ZZ2": (1.4, "kg m2", 8), "XY2": (0.2, "kg m2", 30),
    "MX2": (4.0, "kg m", None), "MY2": (-0.8, "kg m", 10), "MZ2": (0.5, "kg m", 15), "M2": (12.0, "kg", 2),
    "Ia2": (1.2, "kg m2", 5), "Fv1": (8.0, "N m s/rad", 25), "Fv2": (5.0, "N m s/rad", 20),
}  # fmt: skip
ARM = """\
name: arm
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
geometry:
  d2: 0.6 m
joints:
  - {j: 1, sigma: 0, alpha: pi/2, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 0, alpha: pi/3, d: d2, theta: q2, r: 0.2 m}
effects:
  - {effect: rotor_inertia, joints: all}
  - {effect: viscous_friction, joints: all}
parameters:
  drawing:
    values:
"""


@pytest.fixture(scope="module")
def regressors(tmp_path_factory: pytest.TempPathFactory) -> Regressors:
    path = tmp_path_factory.mktemp("prior") / "arm.yaml"
    lines = [
        f"      {name}: {{value: {value}, unit: {unit}{'' if spread is None else f', relative_std: {spread}'}}}"
        for name, (value, unit, spread) in VALUES.items()
    ]
    path.write_text(ARM + "\n".join(lines) + "\n", encoding="utf-8")
    return Regressors(read(path))


def test_zeros_of_a_unit_are_known_though_nothing_else_of_it_is(tmp_path: Path) -> None:
    """Without friction; what of it may be there is small beside all else."""
    path = tmp_path / "arm.yaml"
    none = {name: (0.0 if name.startswith("Fv") else told[0], told[1]) for name, told in VALUES.items()}
    lines = [f"      {name}: {{value: {value}, unit: {unit}}}" for name, (value, unit) in none.items()]
    path.write_text(ARM + "\n".join(lines) + "\n", encoding="utf-8")
    of = Regressors(read(path))
    found = prior_of(of.model, "drawing")
    at = [of.names.index(name) for name in ("Fv1", "Fv2")]
    assert found.known[at].all()
    assert found.mean[at].tolist() == [0.0, 0.0]
    assert np.all(np.diag(found.precision)[at] ** -0.5 < 0.01)
    assert notes_of(of.model, "drawing") == []


@pytest.mark.parametrize(("rotor", "known"), [(None, False), (0.0, True), (5.0, True)])
def test_bodies_alone_do_not_tell_what_their_drives_add(rotor: float | None, known: bool, tmp_path: Path) -> None:
    """An inertia that holds a rotor's is known where the set tells the rotor, if only that there is none."""
    path = tmp_path / "arm.yaml"
    bodies = [
        f"      {name}: {{value: {told[0]}, unit: {told[1]}}}" for name, told in VALUES.items() if name[0] in "XYZM"
    ]
    lines = bodies + ([] if rotor is None else [f"      Ia1: {{value: {rotor}, unit: kg m2}}"])
    path.write_text(ARM + "\n".join(lines) + "\n", encoding="utf-8")
    of = Regressors(read(path))
    (grouped,) = (base for base, terms in of.model.grouping.numeric().items() if "Ia1" in terms)
    found = prior_of(of.model, "drawing")
    assert dict(zip(of.names, found.known.tolist(), strict=True))[grouped] is known
    assert found.known[of.names.index("MX2")]
    expected = [] if known else [f"the set drawing does not tell Ia1 in {grouped}: taken as unknown"]
    assert notes_of(of.model, "drawing") == expected


def test_nothing_is_named_in_the_place_of_rotors_and_friction_that_a_set_leaves_out(tmp_path: Path) -> None:
    bodies = {"ZZ1": 4.0, "MX1": 6.0, "MY1": 0.6, "M2": 10.0, "ZZ2": 1.3, "MX2": 3.1, "MY2": -0.4}
    drives = {"Ia1": 3.0, "Ia2": 0.9, "Fv1": 14.0, "Fc1": 9.0, "Off1": 1.5, "Fv2": 7.0, "Fc2": 4.0, "Off2": -0.8}
    path = tmp_path / "two_links.yaml"
    lines = [
        f"      {name}: {{value: {value}, unit: {UNITS[name[:2]]}, relative_std: 2}}" for name, value in bodies.items()
    ]
    path.write_text("\n".join([TWO_LINKS, "parameters:", "  cad:", "    values:", *lines, ""]), encoding="utf-8")
    of = Regressors(read(path))
    sums = of.model.grouping.numeric()
    whole = bodies | drives
    truth = {base: sum(c * whole.get(one, 0.0) for one, c in terms.items()) for base, terms in sums.items()}
    runs = [str(recorded(of, truth, 40.0, 100.0, k, 0.02).save(tmp_path / f"{k}.csv")) for k in (1, 2, 3)]
    wanted = Request(runs[:1], runs[1:2], runs[2:], "cad")
    found, _ = answered(path, wanted, tmp_path / "out")
    assert (found.verdict, found.findings) == (NOTHING, ())
    assert "the set cad does not tell Ia1 in ZZ1R: taken as unknown" in found.notes


def test_a_grouped_value_needs_none_of_its_parts(tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(f"{ARM}      ZZ1R: 9 kg m2\n      MX2: 4 kg m\n", encoding="utf-8")
    of = Regressors(read(path))
    assert prior_of(of.model, "drawing").known[of.names.index("ZZ1R")]
    assert notes_of(of.model, "drawing") == []


@pytest.mark.parametrize("told", ["", "      kch1: 0 N m/rad3\n"])
def test_what_a_set_does_not_tell_of_an_effect_is_nearly_zero(told: str, tmp_path: Path) -> None:
    """Where it only refines what the set tells: cables of which the stiffness is known hardly harden."""
    cable = "  - {effect: cable_spring, joint: 1, values: {neutral: 0.1 rad}}\n"
    path = tmp_path / "arm.yaml"
    path.write_text(ARM.replace("parameters:\n", f"{cable}parameters:\n") + f"      kc1: 40 N m/rad\n{told}")
    of = Regressors(read(path))
    prior = prior_of(of.model, "drawing")
    at = of.names.index("kch1")
    assert prior.mean[at] == 0
    assert prior.precision[at, at] ** -0.5 == pytest.approx(0.05 * 40, rel=1e-5)


def linear_map(regressors: Regressors) -> Array:
    """Base parameters per standard parameter, from torques of an independent Newton-Euler along random motions."""
    robot = regressors.model.robot
    q, qd, qdd = np.random.default_rng(1).uniform(-2, 2, (3, 2, 60))
    place = {name: k for k, name in enumerate(regressors.names)}
    W = np.zeros((2, 60, len(place)))
    for row, names, columns in zip(W, regressors.structure, regressors.base(Motion(q, qd, qdd)), strict=True):
        row[:, [place[name] for name in names]] = columns.T

    plain = {name: value for name, (value, _, _) in VALUES.items()}

    def torques(values: dict[str, float]) -> Array:
        arm = Arm(robot, values)
        return np.array([arm.torques(*state) for state in zip(q.T, qd.T, qdd.T, strict=True)]).T

    still = torques(plain)
    columns = []
    for name in VALUES:
        if name.startswith(("Ia", "Fv")):
            k = int(name[2]) - 1
            column = np.zeros((2, 60))
            column[k] = qdd[k] if name.startswith("Ia") else qd[k]
        else:
            column = torques({**plain, name: plain[name] + 1.0}) - still
        columns.append(column.reshape(-1))
    solution, *_ = np.linalg.lstsq(W.reshape(-1, len(place)), np.array(columns).T, rcond=None)
    return np.asarray(solution)


def test_mean_and_covariance_are_those_of_the_linear_map(regressors: Regressors) -> None:
    found = prior_of(regressors.model, "drawing")
    values = np.array([value for value, _, _ in VALUES.values()])
    # What has no standard deviation is known to 5 %, or to a thousandth of the largest value of its unit.
    largest = {"kg m": 6.0}
    std = np.array(
        [
            abs(value) * spread / 100 if spread is not None else max(0.05 * abs(value), 1e-3 * largest[unit])
            for value, unit, spread in VALUES.values()
        ]
    )
    L = linear_map(regressors)
    assert found.mean == pytest.approx(L @ values, rel=1e-7, abs=1e-9)
    covariance = L @ np.diag(std**2) @ L.T
    known = found.known
    assert known.tolist() == (np.diag(covariance) > 1e-20).tolist()
    inverse = np.linalg.inv(found.precision[np.ix_(known, known)])
    size = np.sqrt(np.diag(covariance)[known])
    # A millionth of each variance is added, so that sums of the same parameters stay apart.
    assert inverse / np.outer(size, size) == pytest.approx(
        covariance[np.ix_(known, known)] / np.outer(size, size), abs=2e-6
    )


def test_what_the_set_does_not_tell_is_not_known(regressors: Regressors) -> None:
    """Offsets of bodies that the set leaves out are zero there, with no standard deviation of their own."""
    found = prior_of(regressors.model, "drawing")
    place = {name: k for k, name in enumerate(regressors.names)}
    unknown = {name for name, k in place.items() if not found.known[k]}
    assert unknown == {"XZ2", "YZ2"}


def test_a_set_of_the_motor_side_tells_the_same(tmp_path: Path) -> None:
    """Where joints are elastic, and the set has no joint-side value beside it."""
    path = tmp_path / "arm.yaml"
    found = []
    for motor in ("", "m"):
        own = {"Ia1": f"Ia{motor}1", "Fv1": f"Fv{motor}1", "Fv2": "Fv2"}
        lines = [f"      {name}: {{value: {3 + len(old)}, unit: {VALUES[old][1]}}}" for old, name in own.items()]
        path.write_text(ARM.replace("joints:\n", "flexible: all\njoints:\n", 1) + "\n".join(lines) + "\n")
        found.append(prior_of(Regressors(read(path)).model, "drawing"))
    assert found[0].known.any()
    for what in ("mean", "precision"):
        assert np.array_equal(getattr(found[0], what), getattr(found[1], what))


def test_what_is_known_exactly_is_known_best(tmp_path: Path) -> None:
    """Of zero no part is a standard deviation: as where the set tells none it is one of the largest friction's."""
    path = tmp_path / "arm.yaml"
    spreads = {"Fv1": "8, unit: N m s/rad, relative_std: 0", "Fv2": "0, unit: N m s/rad, relative_std: 10"}
    path.write_text(ARM + "".join(f"      {name}: {{value: {told}}}\n" for name, told in spreads.items()))
    made = Regressors(read(path))
    found = prior_of(made.model, "drawing")
    std = {name: found.precision[k, k] ** -0.5 for k, name in enumerate(made.names) if found.known[k]}
    assert std == pytest.approx({"Fv1": 8e-4, "Fv2": 8e-3}, rel=1e-3)


@pytest.mark.parametrize(("prior", "stiffness"), [(None, 1e5), ("a", 1e5), ("b", 3e4)])
def test_the_prior_tells_what_no_base_parameter_holds_before_other_sets(
    prior: str | None, stiffness: float, tmp_path: Path
) -> None:
    sets = {name: {**TRUTH, "k1": k} for name, k in (("a", 1e5), ("b", 3e4))}
    text = f"{diagnosed_arm.ARM}flexible: [1]\n{parameters_text(sets)}"
    _, (source,) = diagnosed_arm.recorded(tmp_path, [torque("")])
    path = tmp_path / "arm.yaml"
    path.write_text(text)
    wanted = Request([source], prior=prior, dry=True)
    found, _ = answered(path, wanted, tmp_path / "out")
    assert {one.stiffness for scene in found.search.bank.scenes for one in stated(scene.robot)} == {stiffness}


def test_an_unknown_set_is_refused(regressors: Regressors) -> None:
    with pytest.raises(InputError) as refused:
        prior_of(regressors.model, "drawings")
    assert "no parameter set 'drawings'" in str(refused.value)
    assert "drawing" in str(refused.value)


def test_what_is_added_and_not_known_takes_its_direction_out_of_the_prior() -> None:
    """The limit of a large standard deviation; a direction that was unknown before changes nothing."""
    prior = Prior(np.zeros(3), np.diag([4.0, 9.0, 0.0]))
    direction = np.array([1.0, 2.0, 0.5])
    unknown, large = (prior.shifted(direction, 0.7, std) for std in (np.inf, 1e6))
    assert unknown.precision == pytest.approx(large.precision, abs=1e-9)
    assert direction @ unknown.precision @ direction == pytest.approx(0.0, abs=1e-12)
    assert prior.shifted(np.array([0.0, 0.0, 1.0]), 0.7, np.inf).precision == pytest.approx(prior.precision)
    assert prior.shifted(direction, 0.7, 0.0).precision == pytest.approx(prior.precision)


@pytest.mark.parametrize("rounding", [-1.4e-18, 3e-20])
def test_a_zero_but_for_rounding_is_not_known_to_its_digits(rounding: float, tmp_path: Path) -> None:
    """As drawings export it: two hundredths of nothing would be all that counts."""
    path = tmp_path / "arm.yaml"
    lines = [
        f"      {name}: {{value: {value}, unit: {unit}, relative_std: 2}}" for name, (value, unit, _) in VALUES.items()
    ]
    path.write_text(ARM + "\n".join([*lines, f"      YZ2: {{value: {rounding}, unit: kg m2, relative_std: 2}}"]) + "\n")
    model = Regressors(read(path)).model
    prior = prior_of(model, "drawing")
    at = [one.name for one in model.base_parameters].index("YZ2")
    largest = max(abs(value) for value, unit, _ in VALUES.values() if unit == "kg m2")
    assert 1e-10 * largest < 1 / np.sqrt(prior.precision[at, at]) < 1e-3 * largest
