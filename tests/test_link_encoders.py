"""Latency of link-side encoders before elasticity: a robot with both, one without elasticity, a real one."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.resources import find_robot
from generator.robot.readers import read
from identification.dataset import load
from identification.inverse_model import identify
from identification.link_encoders import astray, link_encoders, of_runs
from identification.recipes import Recipe
from identification.report.stiffness import report as stiffness_report
from identification.simulation.machine import Machine, compiled
from identification.simulation.run_file import save
from identification.simulation.settings import Settings
from identification.simulation.simulate import Simulated, simulate
from identification.stiffness_results import document
from tests.at_hand import RECORDINGS
from tests.commands import command
from tests.elastic_links import MOTORS, N, robot_text
from tests.recorded import SLIDE, Recorded

LATENCY = 0.003
RUN = Settings(flexible=True, further=("qs",), duration=30.0, link_delay=LATENCY, noise=(0.05,), resolution=(1e-4,))


def simulated(machine: Machine, settings: Settings, path: Path) -> str:
    return str(save(simulate(machine, settings), machine.robot.name, machine.robot.digest, path)[0])


@pytest.fixture(scope="module")
def moved(machine: Machine) -> Simulated:
    return simulate(machine, RUN)


@pytest.fixture(scope="module")
def kept(machine: Machine, moved: Simulated, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return save(moved, machine.robot.name, machine.robot.digest, tmp_path_factory.mktemp("kept") / "a.csv")[0]


@pytest.fixture
def written(kept: Path, tmp_path: Path) -> Path:
    """The file of that run, for one test to change."""
    return shutil.copytree(kept.parent, tmp_path / "written") / kept.name


def test_latency_and_stiffness_are_told_apart(machine: Machine, tmp_path: Path) -> None:
    runs = [simulated(machine, replace(RUN, seed=seed), tmp_path / f"{seed}.csv") for seed in (1, 2)]
    found = link_encoders(machine.robot, runs, MOTORS)
    for name in ("k1", "k2"):
        one, mistaken = found.stiffness[name], found.mistaken[name]
        assert one.value == pytest.approx(MOTORS[name], abs=4 * one.std)
        assert one.value == pytest.approx(MOTORS[name], rel=0.1)
        assert mistaken.value is not None
        assert abs(mistaken.value / MOTORS[name] - 1) > 0.15, "with the latency in it, it is another"
    for one in found.latency.values():
        assert one.value == pytest.approx(LATENCY, abs=4 * one.std)
    assert found.notes == ()
    for rows in found.rows.values():
        columns = np.column_stack([rows.torque, rows.own, rows.constants])
        assert rows.condition == pytest.approx(np.linalg.cond(columns / np.sqrt((columns**2).sum(axis=0))))
    unaware = link_encoders(machine.robot, runs)
    assert "latency1 lacks Fv1/k1: no viscous friction was given" in unaware.notes
    lost = MOTORS["Fvm1"] / MOTORS["k1"]
    assert unaware.latency["latency1"].value == pytest.approx(LATENCY - lost, abs=1e-4)


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.long) for seed in range(1, 6))])
def test_the_latency_moves_no_stiffness(seed: int, machine: Machine, tmp_path: Path) -> None:
    """The torque is that of then: taken of now it moves k by up to 7 % here."""
    found = []
    for delay in (0.0, 0.01):
        settings = replace(RUN, seed=seed, link_delay=delay, noise=(0.001,), resolution=(1e-6,))
        found.append(link_encoders(machine.robot, [simulated(machine, settings, tmp_path / "a.csv")], MOTORS))
    at_once, late = found
    for name, one in at_once.stiffness.items():
        assert late.stiffness[name].value == pytest.approx(one.value, rel=5e-3)
    for name, one in at_once.latency.items():
        assert one.value is not None
        assert late.latency[name].value == pytest.approx(0.01 + one.value, abs=1e-5)


@pytest.mark.parametrize("wrong", [lambda qs: np.degrees(qs), lambda qs: -qs, lambda qs: 0 * qs])
def test_an_encoder_that_does_not_follow_its_motor_is_refused(
    machine: Machine, written: Path, wrong: Callable[[np.ndarray], np.ndarray]
) -> None:
    good = Recorded.read(written)
    good.with_columns(qs2=wrong(good.columns["qs2"])).save(written)
    with pytest.raises(InputError, match=r"a.csv:1:1: qs2 differs from the motor's position by \d+ % of how far"):
        link_encoders(machine.robot, [str(written)])
    run = load(str(written), machine.robot)
    assert [astray(run, k, joint) > 0 for k, joint in enumerate(machine.robot.moving)] == [False, True]


def test_an_encoder_that_is_too_late_is_refused(machine: Machine, written: Path) -> None:
    run = load(str(written), machine.robot)
    steps = round(0.4 / run.period)
    late = {**run.others, "qs1": np.roll(run.others["qs1"], steps)}
    found = of_runs(machine.robot, [replace(run, others=late)], MOTORS)
    told = "no latency up to 0.2 s settles with the torque and the motion of then"
    assert found.latency["latency1"].refused == found.stiffness["k1"].refused == told
    assert found.latency["latency2"].value is not None


def test_a_linear_axis_has_a_latency_too(tmp_path: Path) -> None:
    """A slide whose scale is 4 ms late and whose belt yields, in metres and newtons."""
    (tmp_path / "slide.yaml").write_text(SLIDE)
    robot = read(tmp_path / "slide.yaml")
    t = 1e-3 * np.arange(20000)
    q, qd, qdd = (
        sum(a * w**n * np.sin(w * t + n * np.pi / 2) for a, w in ((0.4, 1.9), (0.1, 5.3), (0.05, 11.0)))
        for n in range(3)
    )
    torque = 80 * qdd + 120 * qd + 60 * np.sign(qd) + 400 * np.sin(3 * q)
    link = q - torque / 5e5
    late = np.interp(t - 0.004, t, link) + 1e-6 * np.random.default_rng(1).normal(size=len(t))
    path = Recorded({"t": t, "q1": q, "tau1": torque, "qs1": late}).save(tmp_path / "a.csv")
    found = link_encoders(robot, [str(path)])
    k, latency = found.stiffness["k1"], found.latency["latency1"]
    assert (k.unit, latency.unit) == ("N/m", "s")
    assert k.value == pytest.approx(5e5, rel=0.02)
    assert latency.value == pytest.approx(0.004, abs=3e-5)


def test_rows_near_a_torque_that_was_lost_are_not_used(machine: Machine, tmp_path: Path) -> None:
    """It stays what it was; the late encoder asks for the torques of then."""
    run = load(simulated(machine, replace(RUN, link_delay=0.006), tmp_path / "a.csv"), machine.robot)
    lost = np.zeros((2, run.samples), dtype=bool)
    tau = run.tau.copy()
    for start in range(2000, 28000, 3000):
        lost[0, start : start + 500] = True
        tau[0, start : start + 500] = tau[0, start]
    for told in (replace(run, unusable=lost), replace(run, tau=tau, unusable=lost)):
        one = of_runs(machine.robot, [told], MOTORS).stiffness["k1"]
        assert one.value == pytest.approx(MOTORS["k1"], abs=3 * one.std)
        assert one.relative_std < 1
    assert of_runs(machine.robot, [replace(run, tau=tau)], MOTORS).stiffness["k1"].value is None


def test_a_rigid_robot_has_no_stiffness_left(machine: Machine, tmp_path: Path) -> None:
    run = simulated(machine, replace(RUN, flexible=False), tmp_path / "rigid.csv")
    found = link_encoders(machine.robot, [run])
    for number in (1, 2):
        assert found.stiffness[f"k{number}"].value is None
        assert found.stiffness[f"k{number}"].refused
        assert found.mistaken[f"k{number}"].value is not None
        one = found.latency[f"latency{number}"]
        assert one.value == pytest.approx(LATENCY, abs=4 * one.std)
    assert found.notes == ()
    told = link_encoders(machine.robot, [run], MOTORS)
    assert told.notes == tuple(f"latency{j} lacks Fv{j}/k{j}: the stiffness is not known" for j in (1, 2))


def test_a_joint_that_stands_has_no_latency(machine: Machine, moved: Simulated, tmp_path: Path) -> None:
    columns = dict(moved.columns)
    q = np.linalg.solve(N, np.stack([columns.pop("qm1"), columns.pop("qm2")]))
    noise = 1e-6 * np.random.default_rng(1).normal(size=q.shape)
    run = Recorded({**columns, "q1": q[0], "q2": 0.3 + noise[0], "qs2": 0.3 + noise[1]}).save(tmp_path / "run.csv")
    found = link_encoders(machine.robot, [str(run)])
    assert found.latency["latency1"].value is not None
    assert found.latency["latency2"].value is None
    assert found.latency["latency2"].refused == "the joint stands still"
    assert not [one for one in link_encoders(machine.robot, [str(run)], MOTORS).notes if "latency2" in one]


def test_a_loaded_joint_that_stands_shows_its_stiffness(tmp_path: Path) -> None:
    """Its latency is that of the noise of its speed, and moves no torque."""
    (tmp_path / "two_links.yaml").write_text(robot_text())
    robot, t, draw = read(tmp_path / "two_links.yaml"), 2e-3 * np.arange(20000), np.random.default_rng(3)
    q = np.stack([0.3 + 1e-5 * draw.normal(size=len(t)), 0.5 * np.sin(2.1 * t) + 0.2 * np.sin(5.3 * t)])
    tau = np.stack([200 * np.cos(q[1]) + 60 * np.sin(3 * t), 80 * np.cos(q[1])])
    linked = q[0] - tau[0] / 2e5 + 1e-6 * draw.normal(size=len(t))
    columns = {"t": t, "q1": q[0], "q2": q[1], "tau1": tau[0], "tau2": tau[1], "qs1": linked}
    found = link_encoders(robot, [str(Recorded(columns).save(tmp_path / "a.csv"))])
    assert found.latency["latency1"].refused == "the joint stands still"
    assert found.stiffness["k1"].value == pytest.approx(2e5, rel=0.05)


@pytest.mark.filterwarnings("error")
def test_a_joint_that_creeps_tells_nothing(machine: Machine, moved: Simulated, written: Path, tmp_path: Path) -> None:
    """It is never faster than a standstill, and has no rows."""
    columns = dict(moved.columns)
    q = np.linalg.solve(N, np.stack([columns.pop("qm1"), columns.pop("qm2")]))
    slow = 0.3 + 0.1 * np.sin(0.1 * columns["t"])
    run = Recorded({**columns, "q1": q[0], "q2": slow, "qs2": slow}).save(tmp_path / "run.csv")
    found = link_encoders(machine.robot, [str(run)])
    assert (found.latency["latency2"].value, found.stiffness["k2"].value) == (None, None)
    assert found.residuals[1].rows == 0
    refused = found.latency["latency2"].refused
    assert refused == found.stiffness["k2"].refused == "no row is above the joint's standstill speed"
    both = link_encoders(machine.robot, [str(run), str(written)])
    for one in (found, both):
        page = stiffness_report.report(one).decode()
        assert ("k2 cannot be told" in page) is (one is found)
    still = Recorded({**columns, "q2": slow, "qs2": slow, "q1": slow, "qs1": slow}).save(tmp_path / "still.csv")
    with pytest.raises(InputError, match="no joint with a link-side encoder moves, expected rows above"):
        link_encoders(machine.robot, [str(still)])


def test_friction_that_sticks_is_no_compliance(tmp_path: Path) -> None:
    """Near a reversal a motor's friction hides any change of the load from the recorded torque."""
    text = robot_text().replace("Fcm1: 9 N m", "Fcm1: 36 N m").replace("Fcm2: 4 N m", "Fcm2: 16 N m")
    (tmp_path / "two_links.yaml").write_text(text)
    with compiled(read(tmp_path / "two_links.yaml")) as rubbing:
        run = simulated(rubbing, replace(RUN, noise=(0.01,), seed=1), tmp_path / "run.csv")
        found = link_encoders(rubbing.robot, [run], MOTORS).stiffness
    for name in ("k1", "k2"):
        assert found[name].value == pytest.approx(MOTORS[name], rel=0.03)


def test_cut_off_currents_shift_no_stiffness(machine: Machine, moved: Simulated, tmp_path: Path) -> None:
    columns = dict(moved.columns)
    for name in ("i1", "i2"):
        columns[name] = np.clip(columns[name], *np.quantile(columns[name], [0.06, 0.94]))
    found = link_encoders(machine.robot, [str(Recorded(columns).save(tmp_path / "run.csv"))], MOTORS)
    assert any("i2 is cut off for" in note for note in found.notes)
    for name in ("k1", "k2"):
        assert found.stiffness[name].value == pytest.approx(MOTORS[name], rel=0.04)


def test_runs_without_link_encoders_are_refused(machine: Machine, tmp_path: Path) -> None:
    run = simulated(machine, replace(RUN, further=(), link_delay=0.0, duration=10.0), tmp_path / "a.csv")
    with pytest.raises(InputError, match="no columns of link-side encoders, expected qs1 to qs2, any of them"):
        link_encoders(machine.robot, [run])
    short = replace(RUN, duration=1.0)
    with pytest.raises(InputError, match=r"1000 rows \(1 s at 1000 Hz\), expected at least"):
        link_encoders(machine.robot, [simulated(machine, short, tmp_path / "b.csv")])


@RECORDINGS.needed
def test_a_real_robots_twist_is_mostly_latency(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Three axes with the same electronics: 3.0 ms each, and false stiffness of a third of the a-priori model's."""
    runs = [RECORDINGS.path / "kr300_r2500" / f"{name}.csv" for name in "AB"]
    robot = read(find_robot("kr300"))
    friction = identify(robot, [str(run) for run in runs], options=None).full.solution.values
    found = link_encoders(robot, [str(run) for run in runs], friction, Recipe())
    assert set(found.latency) == {"latency1", "latency2", "latency3"}
    for one in found.latency.values():
        assert one.value == pytest.approx(3.0e-3, abs=0.2e-3)
        assert one.std < 0.15e-3
    for name, true in (("k1", 4.58e6), ("k2", 7.52e6), ("k3", 4.10e6)):
        mistaken = found.mistaken[name].value
        assert mistaken is not None
        assert mistaken < 0.6 * true
    assert found.stiffness["k1"].value is None
    done = command("stiffness", "kr300", "--link-encoders", "--data", *runs, "--out", tmp_path / "out", capsys=capsys)
    assert done.status == 0
    results = json.loads((tmp_path / "out" / "results.json").read_text())
    assert results["parameters"]["k1"]["refused"].startswith("what the latency leaves shows it with a relative std")
    assert set(results["taken_for_elasticity"]) == {"k1", "k2", "k3"}


def test_a_joint_that_crawls_is_refused_and_the_other_is_not(machine: Machine, written: Path) -> None:
    path = str(written)
    run = load(path, machine.robot)
    crawling = 0.02 * np.sin(0.2 * run.period * np.arange(run.samples))
    slow = replace(run, q=np.stack([run.q[0], crawling]), others={**run.others, "qs2": crawling})
    found = of_runs(machine.robot, [slow], MOTORS)
    assert found.stiffness["k1"].value is not None
    assert found.stiffness["k2"].value is None
    assert np.isfinite(document(found)["condition"])
    crawls = replace(slow, others={"qs2": crawling})
    assert of_runs(machine.robot, [crawls], MOTORS).stiffness["k2"].value is None
    with pytest.raises(InputError, match=r"its samples from 0 s to .* s fit in a.csv"):
        link_encoders(machine.robot, [path, path])
