"""The repaired robot's parameters, and its generated code played against a run: slides and seven axes too."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy import signal

from generator.backends.review import groupings
from generator.resources import find_robot
from generator.robot.description import PRISMATIC, Robot
from generator.symbolic.parameter_sets import resolved_sets
from identification import recipes
from identification.dataset import Run, load
from identification.diagnosis.columns.hypothesis import EFFECT, SIGNAL
from identification.diagnosis.columns.normal_equations import Prior
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.changes import difference, groupings_difference
from identification.diagnosis.mending.refit import Refit, refit, with_payload
from identification.diagnosis.mending.repair import Repaired, repaired
from identification.diagnosis.runs.played import Player, compiled, play
from identification.diagnosis.runs.prepared import prepared
from identification.observation import Motion, Regressors
from identification.outcome import Value
from identification.recipes import Recipe
from identification.robot_file import with_parameter_set
from identification.robot_text import robot_of
from identification.sampling import Sampled, sampled
from identification.sidecar import UNITS, Payload
from tests.bodies import STEMS
from tests.recorded import TRUTH, as_recorded, fourier, recorded, two_links

RATE, SECONDS, DELAY = 250.0, 20.0, 2.4e-3
#: Hidden in the runs: friction with a state on the first joint, a delay, a payload-free robot otherwise.
FOUND = (
    Addition(EFFECT, "dahl_friction", (1,), {"xs": 0.01}, evidence="made for this test"),
    Addition(SIGNAL, "torque_delay", (1, 2, 3, 4), {"torque_delay": DELAY}),
)
DAHL = 40.0


def motion(robot: Robot, seed: int) -> Motion:
    """Sums of four sines a joint, differentiated analytically."""
    rng = np.random.default_rng(seed)
    t = np.arange(0, SECONDS, 1 / RATE)
    w = 2 * np.pi * np.arange(1, 5)[:, None] / 5.0
    q, qd, qdd = [], [], []
    for joint in robot.moving:
        size = 0.1 if joint.sigma == PRISMATIC else 0.5
        a, phase = size * rng.normal(size=4) / np.arange(1, 5), rng.uniform(0, 6, (4, 1))
        middle = 0.0 if joint.lower is None or joint.upper is None else float(joint.lower + joint.upper) / 2
        q.append(middle + a @ np.sin(w * t + phase))
        qd.append((a * w[:, 0]) @ np.cos(w * t + phase))
        qdd.append(-(a * w[:, 0] ** 2) @ np.sin(w * t + phase))
    return Motion(np.array(q), np.array(qd), np.array(qdd))


class Case:
    """A robot whose file lacks two things that its runs have."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.old = folder / "old.yaml"
        self.old.write_text(find_robot("scara").read_text(encoding="utf-8"), encoding="utf-8")
        self.repaired: Repaired = repaired(self.old.read_text(encoding="utf-8"), "scara.yaml", FOUND)
        self.new = folder / "new.yaml"
        self.new.write_text(self.repaired.text, encoding="utf-8")
        self.regressors = Regressors(self.repaired.robot)
        sets = resolved_sets(self.regressors.model)
        self.truth = {name: sets["example"].get(name, 0.0) for name in self.regressors.names} | {"Fd1": DAHL}
        self.runs = [self._run(seed) for seed in (1, 2, 3)]
        self.recipe = recipes.recipe_of("scara").changed(cutoff=40.0, factor=5, standstill=0.01)

    def _run(self, seed: int) -> Path:
        t = np.arange(0, SECONDS, 1 / RATE)
        made = motion(self.repaired.robot, seed)
        fine = np.interp(np.arange(len(t) * 20) / 20, np.arange(len(t)), made.qd[0])
        z = np.zeros(len(fine) + 1)
        for k, v in enumerate(fine):  # one implicit step each
            z[k + 1] = (z[k] + v / (20 * RATE) / 0.01) / (1 + abs(v) / (20 * RATE) / 0.01)
        tau = self.regressors.torques(self.truth, Motion(made.q, made.qd, made.qdd, z[None, :-1:20]))
        tau += 1e-3 * np.ptp(tau, axis=1)[:, None] * np.random.default_rng(seed).normal(size=tau.shape)
        late = np.stack([np.interp(t - DELAY, t, row) for row in tau])
        return as_recorded(self.regressors, t, made.q, late).save(self.folder / f"run{seed}.csv")

    def run(self, k: int, robot: Robot) -> Run:
        return load(str(self.runs[k]), robot)

    def sampled(self, k: int, regressors: Regressors) -> Sampled:
        return sampled(self.run(k, regressors.model.robot), self.recipe, regressors)


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Case:
    return Case(tmp_path_factory.mktemp("case"))


@pytest.fixture(scope="module")
def fitted(case: Case) -> Refit:
    return refit([case.sampled(k, case.regressors) for k in (0, 1)], case.regressors)


def test_the_refit_finds_the_truth_and_the_file_keeps_it(case: Case, fitted: Refit) -> None:
    seen = [name for name in fitted.values if np.isfinite(fitted.std[name]) and fitted.std[name] > 0]
    assert "Fd1" in seen
    assert fitted.values["Fd1"] == pytest.approx(DAHL, abs=max(0.03 * DAHL, 4 * fitted.std["Fd1"]))
    text = with_parameter_set(case.repaired.text, fitted.parameter_set)
    robot = robot_of(text, "new.yaml")
    assert float(robot.parameter_sets["diagnosed"].values["Fd1"].value) == pytest.approx(fitted.values["Fd1"], rel=1e-5)
    assert set(resolved_sets(Regressors(robot).model)["diagnosed"]) >= set(fitted.values)


@pytest.mark.parametrize("near", [False, True])
def test_what_the_runs_do_not_ask_for_stays_zero(near: bool, case: Case, fitted: Refit) -> None:
    of = case.regressors
    prior = Prior(np.array(list(fitted.values.values())), np.eye(len(of.names))) if near else None
    found = refit([case.sampled(k, of) for k in (0, 1)], of, prior, given={"Fd1": Value(0.0, 0.0, "N m")})
    assert found.values["Fd1"] == found.std["Fd1"] == 0
    assert float(found.parameter_set.values["Fd1"].value) == 0
    assert found.values["Fc1"] > fitted.values["Fc1"]


def test_a_finding_stays_as_it_was_found(case: Case, fitted: Refit) -> None:
    """And what acts with it follows: what both make of a long motion stays the same."""
    of, less = case.regressors, 0.9 * fitted.values["Fd1"]
    found = refit([case.sampled(k, of) for k in (0, 1)], of, given={"Fd1": Value(less, 0.02, "N m")})
    written = found.parameter_set.values["Fd1"]
    assert (found.values["Fd1"], found.std["Fd1"]) == (less, 0.02)
    assert float(written.value) == less
    assert written.relative_std == pytest.approx(100 * 0.02 / less)
    gained = found.values["Fc1"] - fitted.values["Fc1"]
    assert gained == pytest.approx(fitted.values["Fd1"] - less, rel=0.5)
    # As uncertain as what is given makes it, beside its own rows.
    exact = refit([case.sampled(k, of) for k in (0, 1)], of, given={"Fd1": Value(less, 0.0, "N m")})
    more = refit([case.sampled(k, of) for k in (0, 1)], of, given={"Fd1": Value(less + 0.02, 0.02, "N m")})
    moved = more.values["Fc1"] - found.values["Fc1"]
    assert found.std["Fc1"] == pytest.approx(np.hypot(exact.std["Fc1"], moved), rel=1e-3)
    assert abs(moved) > 0.5 * 0.02


def test_a_joint_without_rows_stays_as_it_was_known(case: Case, fitted: Refit) -> None:
    of = case.regressors
    prior = Prior(np.array(list(fitted.values.values())), np.eye(len(of.names)))
    one = case.sampled(0, of)
    standing = one.left_out.copy()
    standing[3] = True
    found = refit([replace(one, left_out=standing)], of, prior)
    assert found.values["Fc4"] == pytest.approx(fitted.values["Fc4"])
    assert found.std["Fc4"] == pytest.approx(1.0, rel=0.1)
    assert found.values["Fc1"] == pytest.approx(fitted.values["Fc1"], rel=0.1)


def test_what_is_held_stays_nearer_to_what_was_known(case: Case, fitted: Refit) -> None:
    """A quarter of every value is much beside what is stated: it was known less well, unless it is held."""
    of = case.regressors
    values = np.array(list(fitted.values.values()))
    known = Prior(1.25 * values, np.diag((1e-3 * np.abs(values) + 1e-4) ** -2.0))
    runs = [case.sampled(k, of) for k in (0, 1)]
    free, held = (np.array([*refit(runs, of, known, held=one).values.values()]) for one in (False, True))
    far = [float((x - known.mean) @ known.precision @ (x - known.mean)) for x in (free, held)]
    assert far[1] < 0.9 * far[0]


def test_the_gap_closes_in_the_generated_c(case: Case, fitted: Refit) -> None:
    player, notes = compiled(case.new, case.folder / "generated", case.regressors)
    assert not notes
    assert player.folder == case.folder / "generated" / "scara"
    one = prepared(case.run(2, case.regressors.model.robot), case.recipe, case.regressors)
    after = play(one, player, fitted.values)
    own = play(one, Player(case.regressors), fitted.values)
    assert np.abs(after.model - own.model).max() < 1e-9 * np.abs(own.model).max()
    old = Regressors(robot_of(case.old.read_text(encoding="utf-8"), "old.yaml"))
    was = refit([case.sampled(k, old) for k in (0, 1)], old)
    before = play(prepared(case.run(2, old.model.robot), case.recipe, old), Player(old), was.values)
    first, last = (one.residuals.per_joint[0].relative_to_mean for one in (before, after))
    assert last < 0.5 * first
    assert after.residuals.total.relative_to_mean < 1.0
    assert after.t.shape == after.measured.shape[1:] == after.kept.shape[1:]


def test_without_a_compiler_numpy_plays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", "no-such-compiler")
    regressors = Regressors(robot_of(find_robot("emps").read_text(encoding="utf-8"), "emps.yaml"))
    player, notes = compiled(find_robot("emps"), tmp_path, regressors)
    assert player.folder == tmp_path / "emps"
    assert "no-such-compiler" in notes[0]
    steady = Motion(np.zeros((1, 3)), np.array([[0.1, 0.2, -0.2]]), np.zeros((1, 3)))
    values = {"Fv1": 200.0, "Fc1": 20.0}
    np.testing.assert_allclose(player.torques(values, steady), [[40.0, 60.0, -60.0]], rtol=1e-12)


def test_what_is_known_holds_where_the_runs_say_little(case: Case, fitted: Refit) -> None:
    names = case.regressors.names
    mean = np.array([case.truth[name] for name in names])
    std = np.where(np.array(names) == "Fd1", np.inf, 1e-6 * np.maximum(np.abs(mean), 1e-3))
    near = refit([case.sampled(0, case.regressors)], case.regressors, Prior(mean, np.diag(std**-2.0)))
    others = np.array(names) != "Fd1"
    found = np.array([near.values[name] for name in names])
    np.testing.assert_allclose(found[others], mean[others], rtol=1e-3, atol=1e-9)
    assert near.values["Fd1"] == pytest.approx(DAHL, rel=0.02)
    far = refit([case.sampled(0, case.regressors)], case.regressors, Prior(mean, np.zeros((len(names), len(names)))))
    free = refit([case.sampled(0, case.regressors)], case.regressors)
    assert far.values["Fd1"] == pytest.approx(free.values["Fd1"], rel=1e-3)


@pytest.mark.parametrize("known", [False, True])
@pytest.mark.parametrize("time", [0.0, 0.2])
def test_standard_deviations_are_those_of_the_noise_s_colour(time: float, known: bool, tmp_path: Path) -> None:
    """Values of repeated fits scatter by what is told of them, whether noise stays for a while [s] or not."""
    of, rate = two_links(tmp_path), 100.0
    stays = np.exp(-1 / (rate * time)) if time else 0.0
    vague = Prior(np.array([TRUTH[name] for name in of.names]), 1e-6 * np.eye(len(of.names))) if known else None
    away = []
    for seed in range(4):
        t, way = fourier(of.model.robot, 60.0, rate, seed)
        drawn = np.random.default_rng(seed).normal(scale=0.7 * np.sqrt(1 - stays**2), size=(2, len(t) + 1000))
        tau = of.torques(TRUTH, way) + signal.lfilter([1], [1, -stays], drawn)[:, 1000:]
        run = load(str(as_recorded(of, t, way.q, tau).save(tmp_path / f"{seed}.csv")), of.model.robot)
        fit = refit([prepared(run, recipes.recipe_of("two_links"), of).sampled], of, vague)
        away += [(fit.values[name] - TRUTH[name]) / fit.std[name] for name in of.names]
    assert 0.6 < np.sqrt(np.mean(np.square(away))) < 1.4


def test_runs_may_carry_other_payloads_of_one_name(tmp_path: Path) -> None:
    of, bodies = (
        two_links(tmp_path),
        ([0.1, 0, 0, 0.1, 0, 0.1, 0.4, 0, 0, 5.0], [0.3, 0, 0, 0.3, 0, 0.3, 0.9, 0.1, 0, 9.0]),
    )
    runs = []
    for seed, body in enumerate(bodies, 1):
        path = recorded(of, TRUTH, seed=seed, payload=body).save(tmp_path / f"{seed}.csv")
        run = replace(load(str(path), of.model.robot), payload=Payload("L", dict(zip(UNITS, body, strict=True))))
        runs.append(sampled(run, Recipe(), of))
    found = refit(runs, of)
    assert found.values == pytest.approx(TRUTH, rel=2e-2, abs=2e-2)


@pytest.mark.parametrize("name", ["scara", "lbr_iiwa14"])
def test_a_payload_is_one_of_base_parameters(name: str) -> None:
    regressors = Regressors(robot_of(find_robot(name).read_text(encoding="utf-8"), name))
    nothing = Prior(np.zeros(len(regressors.names)), 100.0 * np.eye(len(regressors.names)))
    payload = {"M": 3.0, "MX": 0.2, "MY": -0.1, "MZ": 0.5, "I": 0.04, "XX-I": 0.01, "XZ": -0.02}
    prior = with_payload(nothing, regressors, payload, {"M": 0.3})
    std = np.sqrt(np.diag(np.linalg.inv(prior.precision)))
    assert (std >= 0.1 - 1e-12).all()
    assert std.max() > 0.1
    along = motion(regressors.model.robot, 5).part(0, 50)
    ten = {"XX": 0.05, "XZ": -0.02, "YY": 0.04, "ZZ": 0.04, "M": 3.0, "MX": 0.2, "MY": -0.1, "MZ": 0.5}
    body = np.array([ten.get(stem, 0.0) for stem in STEMS])
    expected = np.stack([body @ columns for columns in regressors.payload(along)])
    found = regressors.torques(dict(zip(regressors.names, prior.mean.tolist(), strict=True)), along)
    np.testing.assert_allclose(found, expected, atol=1e-8 * np.abs(expected).max())


def test_what_changed_is_told(case: Case) -> None:
    old = robot_of(case.old.read_text(encoding="utf-8"), "old.yaml")
    text = difference(case.old.read_text(encoding="utf-8"), case.repaired.text, "scara.yaml")
    assert "+  - {effect: dahl_friction, joint: 1, values: {xs: 0.01 rad}}" in text
    assert not [line for line in text.splitlines() if line.startswith("-") and not line.startswith("---")]
    assert difference("a\n", "a\n", "x") == ""
    models = Regressors(old).model, case.regressors.model
    changed = groupings_difference(*models)
    assert any(line.startswith("+") and "Fd1" in line for line in changed.splitlines())
    assert "Fd1" not in groupings(models[0])
