"""What an identification tells where runs show little, and what it refuses."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError, Place
from generator.robot.description import ParameterSet, ParameterValue
from generator.robot.readers import read
from generator.symbolic.parameter_sets import resolved_sets
from identification.consistent_fit import consistent_fit
from identification.fixing import fixed
from identification.inverse_model import Options, identify
from identification.observation import Motion, Regressors
from identification.recipes import Recipe
from identification.results import document, parameter_sets
from identification.sensitivity import sensitivity
from tests.commands import command
from tests.recorded import (
    TRUTH,
    TWO_LINKS,
    Array,
    Recorded,
    as_recorded,
    fourier,
    parameters_text,
    recorded,
    regressors,
)

PLAIN = Recipe(dynamics=4.0, standstill=0.0)

#: Two slides and a wheel without a first moment.
GANTRY = """\
name: gantry
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 1, alpha: pi/2, d: 0, theta: 0, r: q1, limits: [-1 m, 1 m]}
  - {j: 2, sigma: 1, alpha: pi/2, d: 0, theta: pi/2, r: q2, limits: [-1 m, 1 m]}
  - {j: 3, sigma: 0, alpha: 0, d: 0, theta: q3, r: 0, limits: [-160 deg, 160 deg]}
effects:
  - {effect: viscous_friction, joints: all}
  - {effect: coulomb_friction, joints: all}
"""
GANTRY_TRUTH = {"M1": 80.0, "M2R": 30.0, "ZZ3": 2.0, "Fv1": 100.0, "Fc1": 50.0, "Fv2": 60.0, "Fc2": 20.0}
GANTRY_TRUTH |= {"Fv3": 5.0, "Fc3": 2.0}


def gantry(folder: Path, slow: float = 1.0) -> tuple[Regressors, Path]:
    """Its slides pushed by something that the model lacks, the wheel ``slow``."""
    (folder / "gantry.yaml").write_text(GANTRY)
    of = Regressors(read(folder / "gantry.yaml"))
    t, motion = fourier(of.model.robot, 20.0, 200.0)
    scale = np.array([1.0, 1.0, slow])[:, None]
    motion = Motion(motion.q * scale, motion.qd * scale, motion.qdd * scale)
    truth = {name: GANTRY_TRUTH.get(name, 0.0) for name in of.names}
    tau = of.torques(truth, motion)
    tau[0] += 0.15 * tau[0].std() * np.sign(np.sin(7 * motion.q[0]))
    tau += 0.01 * np.random.default_rng(3).normal(size=tau.shape)
    columns = {f"{stem}{j + 1}": row for stem, rows in (("q", motion.q), ("tau", tau)) for j, row in enumerate(rows)}
    return of, Recorded({"t": t, **columns}).save(folder / "run.csv")


def test_bodies_of_which_nothing_is_known_do_not_weigh_on_those_that_slides_show(tmp_path: Path) -> None:
    """A ball as heavy as the noise of first moments that are none would be a million times too light."""
    of, run = gantry(tmp_path)
    found = identify(of.model.robot, [run], options=Options(recipe=PLAIN), regressors=of)
    possible = consistent_fit(found, None, 0.03)
    assert possible.train.total.norm < 1.02 * found.full.train.total.norm
    assert possible.base["M2R"] == pytest.approx(30.0, rel=5e-6)


def test_a_joint_that_hardly_moves_is_not_swapped_with_another(tmp_path: Path) -> None:
    of, run = gantry(tmp_path, slow=0.005)
    found = identify(of.model.robot, [run], options=Options(recipe=Recipe(dynamics=4.0)), regressors=of)
    assert any("joint 3 is never faster than the standstill threshold" in note for note in found.notes)


def test_runs_without_a_row_are_refused(links: Regressors, tmp_path: Path) -> None:
    path = recorded(links, TRUTH).save(tmp_path / "a.csv")
    with pytest.raises(InputError, match=r"a.csv:1:1: no row is left: joints are never faster"):
        identify(links.model.robot, [path], options=Options(Recipe(dynamics=4.0, standstill=100.0)), regressors=links)


@pytest.mark.parametrize(("recipe", "wanted"), [(Recipe(), 10), (Recipe(dynamics=4.0), 20), (Recipe(cutoff=6.75), 0)])
def test_a_cut_off_that_the_rate_lowers_is_told(
    recipe: Recipe, wanted: float, links: Regressors, tmp_path: Path
) -> None:
    """To 0.45 of it: also that which follows from the dynamics."""
    run = recorded(links, TRUTH, rate=15.0, duration=60.0, noise=0.01).save(tmp_path / "coarse.csv")
    found = identify(links.model.robot, [run], options=Options(recipe), regressors=links)
    told = [note for note in found.notes if "cut-off" in note]
    assert told == [f"{run}: the cut-off is 6.75 Hz, the highest at 15 Hz, not {wanted} Hz"][: bool(wanted)]


def test_rows_with_a_torque_that_is_cut_off_do_not_count(links: Regressors, tmp_path: Path) -> None:
    """A clean run with one torque cut off at its 95 % quantile: what else is there gives the truth."""
    whole = recorded(links, TRUTH)
    limit = float(np.quantile(whole.columns["tau1"], 0.95))
    cut = whole.with_columns(tau1=np.minimum(whole.columns["tau1"], limit)).save(tmp_path / "cut.csv")
    options = Options(recipe=Recipe(dynamics=4.0))
    found = identify(links.model.robot, [cut], options=options, regressors=links).full
    assert {name: found.solution.values[name] for name in TRUTH} == pytest.approx(TRUTH, rel=2e-3, abs=0.02)
    assert found.train.total.relative_to_mean < 0.1


def test_rows_that_lost_samples_leave_out_are_told_from_slow_ones(links: Regressors, tmp_path: Path) -> None:
    """One sample in forty is lost, and the decimation's window is as wide."""
    whole = recorded(links, TRUTH, noise=0.01)
    kept = np.arange(4000) % 40 != 20
    lost = Recorded({name: values[kept] for name, values in whole.columns.items()}).save(tmp_path / "lost.csv")
    options = Options(Recipe(dynamics=4.0, factor=20))
    with pytest.raises(
        InputError, match=r"lost.csv:1:1: no row is left: each would hold a sample that was lost or cut"
    ):
        identify(links.model.robot, [lost], options=options, regressors=links)
    found = identify(links.model.robot, [lost, whole.save(tmp_path / "whole.csv")], options=options, regressors=links)
    told = f"{lost}: joint 1 and joint 2 have no rows: each would hold a sample that was lost or cut off"
    assert found.notes[1:] == (told,)
    # Ten samples to either side fit between two of the lost ones.
    options = Options(Recipe(dynamics=4.0, factor=10))
    assert identify(links.model.robot, [lost], options=options, regressors=links).full.train.total.rows > 0


def test_runs_are_long_enough_for_every_stage_of_the_decimation(links: Regressors, tmp_path: Path) -> None:
    """Factors of 20 and 14 have two stages, the second of which needs 25 rows of the first."""
    for rate, factor in ((200.0, 20), (140.0, 14)):
        recipe = Recipe(dynamics=4.0, factor=factor)
        fewest = recipe.at(rate).fewest
        run = recorded(links, TRUTH, rate=rate)
        identify(links.model.robot, [run.rows(0, fewest).save(tmp_path / "b.csv")], options=Options(recipe))
        with pytest.raises(InputError, match=rf"{fewest - 1} rows .* at least {fewest} for the filters"):
            identify(links.model.robot, [run.rows(0, fewest - 1).save(tmp_path / "b.csv")], options=Options(recipe))


def test_a_run_too_short_for_other_filters_is_identified_from_all_the_same(links: Regressors, tmp_path: Path) -> None:
    path = recorded(links, TRUTH, duration=1.6, noise=0.01).save(tmp_path / "short.csv")
    found = identify(links.model.robot, [path], options=Options(PLAIN), regressors=links)
    tried, notes = sensitivity(found, [path])
    assert tried
    assert notes
    assert all("could not be tried" in note for note in notes)


def still_second(of: Regressors, seed: int) -> tuple[Array, Motion]:
    """Times and a motion of the first joint alone."""
    t, motion = fourier(of.model.robot, 20.0, 200.0, seed)
    return t, Motion(*(np.array([[1.0], [0.0]]) * one for one in (motion.q, motion.qd, motion.qdd)))


def test_the_set_makes_the_torques_of_runs_that_show_parameters_only_in_sums(links: Regressors, tmp_path: Path) -> None:
    t, motion = still_second(links, seed=1)
    path = as_recorded(links, t, motion.q, links.torques(TRUTH, motion)).save(tmp_path / "a.csv")
    found = identify(links.model.robot, [path], options=Options(Recipe(dynamics=4.0)), regressors=links)
    written = parameter_sets(found)[0].values
    assert {"Fv2", "Fc2"}.isdisjoint(written)
    hidden = set(found.full.solution.hidden) & written.keys()
    assert hidden & set(found.essential.sought)
    stated = document(found)["parameters"]
    assert not [name for name, one in stated.items() if one["essential"] and one["value"] is None]
    assert {"ZZ1R", "MX1R", "ZZ2", "MX2"} <= hidden
    assert {written[name].relative_std for name in hidden} == {1e5}
    (told,) = (note for note in found.notes if "one by one" in note)
    assert set(told.removeprefix("the runs do not show ").split(" one by one")[0].split()) == hidden
    _, other = still_second(links, seed=5)
    played = {name: written[name].value if name in written else 0.0 for name in TRUTH}
    torque = links.torques(TRUTH, other)[0]
    assert np.abs(links.torques(played, other)[0] - torque).max() < 0.01 * torque.std()


def test_every_run_is_tried_with_other_filters_than_its_own(links: Regressors, tmp_path: Path) -> None:
    """Runs at two rates, whose factors differ: which comes first does not matter."""
    runs = [
        recorded(links, TRUTH, rate=rate, seed=seed, noise=0.05).save(tmp_path / f"{rate:g}.csv")
        for seed, rate in enumerate((400.0, 100.0), 1)
    ]
    found = identify(links.model.robot, runs, options=Options(PLAIN), regressors=links)
    tried, _ = sensitivity(found, runs)
    again, _ = sensitivity(
        identify(links.model.robot, runs[::-1], options=Options(PLAIN), regressors=links), runs[::-1]
    )
    assert [one.value for one in tried] == [10.0, 40.0, 10.0, 40.0]
    assert [one.value for one in again] == [10.0, 40.0, 2.0, 10.0]
    assert [one.parameter for one in again] == [one.parameter for one in tried]
    assert [one.change for one in again] == pytest.approx([one.change for one in tried], rel=1e-6)
    # Half the cut-off of 20 Hz written out; factors follow from the rates.
    half = identify(
        links.model.robot, runs, options=Options(PLAIN.changed(cutoff=10.0)), regressors=links
    ).full.solution
    own = found.full.solution
    moved = {name: abs(half.values[name] - own.values[name]) / own.std(name) for name in TRUTH}
    assert tried[0].change == pytest.approx(max(moved.values()), rel=1e-6)


def test_all_parameters_may_be_given(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    of = regressors("tilted_two_link")
    run = recorded(of, resolved_sets(of.model)["example"]).save(tmp_path / "a.csv")
    given = ("--fix", "*", "--prior", "example", "--sensitivity", "--out", tmp_path)
    done = command("identify", "tilted_two_link", "--data", run, *given, capsys=capsys)
    assert done.status == 0
    assert "every value is given" in done.out


SETS = {
    "friction": {"Fv1": 14.0, "Fc1": 9.0},
    "essential": {"ZZ1R": 9.0, "MX2": 3.1, "Ia2": 0.9},
    "standard": {"M2": 6.0, "MX2": 3.1},
}


@pytest.mark.parametrize(
    ("name", "requests", "values"),
    [
        ("friction", ["Fv1", "Fc1"], {"Fv1": 14.0, "Fc1": 9.0}),
        ("friction", ["Fv1", "Fv2=7"], {"Fv1": 14.0, "Fv2": 7.0}),
        ("essential", ["bodies"], {"ZZ1R": 9.0, "MX1R": 0.0, "MY1": 0.0, "ZZ2": 0.0, "MX2": 3.1, "MY2": 0.0}),
        # The second body is 0.5 m from the first axis.
        ("standard", ["MX1R", "MY1"], {"MX1R": 0.5 * 6.0, "MY1": 0.0}),
        ("friction", ["Fv*"], "Fv2"),
        ("friction", ["bodies"], "ZZ1R"),
        ("essential", ["bodies", "Ia*", "Off2"], "Off2"),
        ("standard", ["Ia2"], "Ia2"),
    ],
)
def test_a_value_is_taken_from_a_set_that_tells_it(
    name: str, requests: list[str], values: dict[str, float] | str, tmp_path: Path
) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text(TWO_LINKS + parameters_text(SETS))
    model = Regressors(read(path)).model
    prior = model.robot.parameter_sets[name]
    if isinstance(values, dict):
        assert fixed(requests, prior, model, Place("--fix")) == pytest.approx(values)
        return
    told = f"--fix:1:1: the set {name} does not tell {values}, expected {values}=VALUE, or a set of values that has it"
    with pytest.raises(InputError, match=f"^{told}$"):
        fixed(requests, prior, model, Place("--fix"))


def test_what_only_serves_a_sum_is_not_told_by_a_set(links: Regressors) -> None:
    unit = "N m s/rad"
    values = {"Fv1": ParameterValue(14.0, unit, 2.0), "Fv2": ParameterValue(-7000.0, unit, 1e5)}
    prior = ParameterSet("sums", "", "", values)
    assert fixed(["Fv1"], prior, links.model, Place("--fix")) == {"Fv1": 14.0}
    with pytest.raises(InputError, match="the set sums does not tell Fv2"):
        fixed(["Fv*"], prior, links.model, Place("--fix"))


def test_a_set_that_does_not_tell_what_is_given_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    robot = tmp_path / "robot.yaml"
    robot.write_text(TWO_LINKS + parameters_text(SETS))
    words = ("--data", tmp_path / "none.csv", "--fix", "Fv2", "--prior", "friction", "--out", tmp_path / "out")
    done = command("identify", robot, *words, capsys=capsys)
    errors = [line for line in done.err.splitlines() if line.startswith("error: ")]
    told = "the set friction does not tell Fv2, expected Fv2=VALUE, or a set of values that has it"
    assert (done.status, errors) == (2, [f"error: --fix:1:1: {told}"])


@pytest.mark.parametrize("robust", [False, pytest.param(True, marks=pytest.mark.long)])
def test_blocks_tell_what_a_sum_of_hidden_parameters_owes_to_others(robust: bool, tmp_path: Path) -> None:
    """A carriage that never turns back: Coulomb friction and offset are one, which leans on viscous friction."""
    of = regressors("emps")
    draw = np.random.default_rng(0)
    t = np.arange(0, 20, 0.002)
    w = 2 * np.pi * np.array([0.2, 0.5])
    qd = 0.1 + 0.04 * np.sin(w[0] * t) + 0.02 * np.sin(w[1] * t + 1)
    qdd = 0.04 * w[0] * np.cos(w[0] * t) + 0.02 * w[1] * np.cos(w[1] * t + 1)
    q = 0.1 * t - 0.04 / w[0] * np.cos(w[0] * t) - 0.02 / w[1] * np.cos(w[1] * t + 1) - 1.0
    clean = of.torques({"M1R": 95.0, "Fv1": 200.0, "Fc1": 20.0, "Off1": -3.0}, Motion(*(x[None] for x in (q, qd, qdd))))
    found: list[float] = []
    plain: list[float] = []
    blocks: list[float] = []
    for _ in range(12):
        noisy = clean[0] + 5 * draw.normal(size=t.shape)
        path = Recorded({"t": t, "q1": q, "tau1": noisy}).save(tmp_path / "run.csv")
        for draws, into in ((0, plain), (300, blocks)):
            solution = identify(of.model.robot, [path], (), Options(Recipe(), robust=robust, draws=draws), of).full
            into.append(solution.solution.std("Fv1"))
        found.append(solution.solution.values["Fv1"])
    assert set(solution.solution.hidden) == {"Fc1", "Off1"}
    scatter = float(np.std(found, ddof=1))
    assert 0.6 < np.mean(plain) / scatter < 1.6
    assert 0.6 < np.mean(blocks) / scatter < 1.6
