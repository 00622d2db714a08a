"""Simulated runs: what is logged, what the trajectories do, and that identification finds the robot in them again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.resources import find_robot
from generator.robot.readers import read
from identification.inverse_model import Options, identify
from identification.observation import Motion, Regressors
from identification.recipes import Recipe
from identification.simulation.checks import check
from identification.simulation.machine import Machine, compiled
from identification.simulation.run_file import save
from identification.simulation.settings import Settings
from identification.simulation.simulate import Simulated, simulate
from identification.trajectories import trajectories
from identification.trajectory import Reference, Task, Unplanned
from tests.commands import command
from tests.elastic_links import MOTORS
from tests.recorded import TRUTH, Recorded
from tests.simulated_runs import SHORT, columns, motors

# -- identification ---------------------------------------------------------------------------------------------------


def test_identification_finds_the_robot_within_its_stated_uncertainty(machine: Machine, tmp_path: Path) -> None:
    regressors, deviations = Regressors(machine.robot), []
    settings = Settings(noise=(0.05, 0.08), resolution=(1e-3,), rate=500.0)
    for seed in range(6):
        run = simulate(machine, replace(settings, seed=seed))
        path, _ = save(run, machine.robot.name, machine.robot.digest, tmp_path / f"{seed}.csv")
        found = identify(machine.robot, [str(path)], [], Options(recipe=Recipe()), regressors).full
        assert set(found.sought) == set(TRUTH)
        deviations += [(found.solution.values[n] - TRUTH[n]) / found.solution.std(n) for n in TRUTH]
        assert found.solution.std("Fc1") < 0.03 * TRUTH["Fc1"]
    inside = np.mean(np.abs(deviations) < 2)
    assert inside > 0.88
    assert 0.7 < np.sqrt(np.mean(np.square(deviations))) < 1.3


def test_a_run_goes_from_command_to_command(file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run = tmp_path / "runs" / "a.csv"
    words = ("--noise", "0.05", "--duration", "10", "--rate", "500")
    done = command("simulate", file, "--out", run, *words, capsys=capsys)
    assert (done.status, done.err.splitlines()[-1]) == (0, "simulating 10 s")
    assert done.out.splitlines()[0] == "two_links: 5000 rows of t, qm1, qm2, i1, i2"
    beside = run.with_suffix(".yaml").read_text()
    for line in ("robot: two_links", "  parameters: twin", "  seed: 0", "  noise: [0.05]", "    Fc2: 4"):
        assert line in beside.splitlines()
    done = command("identify", file, "--data", run, "--out", tmp_path / "out", "--no-consistent", capsys=capsys)
    assert done.status == 0
    other = tmp_path / "b.csv"
    assert command("simulate", file, "--out", other, *words, capsys=capsys).status == 0
    assert other.read_bytes() == run.read_bytes()
    assert other.with_suffix(".yaml").read_bytes() == run.with_suffix(".yaml").read_bytes()


# -- what is logged ---------------------------------------------------------------------------------------------------


def test_the_motors_obey_their_equations(machine: Machine) -> None:
    """Motor side of report eq. 12: tau = Iam qdd + Fvm qd + Fcm sign(qd) + Offm + k (q - link)."""
    run = simulate(machine, replace(SHORT, flexible=True, duration=10.0, seed=2))
    q, tau = motors(run)
    h = 1e-3
    qd, qdd = (q[2:] - q[:-2]) / (2 * h), (q[2:] - 2 * q[1:-1] + q[:-2]) / h**2
    wound = (q - columns(run, "qs"))[1:-1]
    assert np.abs(wound).max() > 1e-4
    for k in range(2):
        steady = np.abs(qd[:, k]) > 0.05
        one = np.ones(steady.sum())
        A = np.stack([qdd[steady, k], qd[steady, k], np.sign(qd[steady, k]), one, wound[steady, k]], 1)
        found = np.linalg.lstsq(A, tau[1:-1][steady, k], rcond=None)[0]
        for stem, value in zip(("Iam", "Fvm", "Fcm", "Offm", "k"), found, strict=True):
            assert value == pytest.approx(MOTORS[f"{stem}{k + 1}"], rel=0.02, abs=0.02), stem


def test_motors_follow_and_links_are_theirs_where_they_are_rigid(machine: Machine) -> None:
    run = simulate(machine, SHORT)
    q, _ = motors(run)
    assert np.abs(q - columns(run, "qr")).max() < 0.02
    assert np.abs(q - columns(run, "qs")).max() < 1e-9
    flexible = simulate(machine, replace(SHORT, flexible=True))
    q, tau = motors(flexible)
    for still in (q[:50], columns(flexible, "qs")[:50]):
        assert np.ptp(still, axis=0).max() < 1e-5, "the log begins at rest"
    assert np.abs(tau[0]).max() > 1.0, "and under the weight"


def test_encoders_noise_and_rates(machine: Machine) -> None:
    clean = simulate(machine, SHORT)
    noisy = simulate(machine, replace(SHORT, noise=(0.3, 0.0)))
    difference = columns(noisy, "i") - columns(clean, "i")
    assert difference.std(axis=0) == pytest.approx([0.3, 0.0], rel=0.05)
    assert (columns(noisy, "qm") == columns(clean, "qm")).all()
    again = simulate(machine, replace(SHORT, noise=(0.3, 0.0), noise_seed=7))
    assert (columns(again, "i")[:, 0] != columns(noisy, "i")[:, 0]).all()
    coarse = columns(simulate(machine, replace(SHORT, resolution=(0.01, 0.05))), "qm") / [0.01, 0.05]
    assert np.abs(coarse - np.round(coarse)).max() < 1e-6
    slow = simulate(machine, replace(SHORT, log_rate=200.0))
    for name, values in slow.columns.items():
        assert (values == clean.columns[name][::5]).all()


def test_delays_shift_what_they_are_of(machine: Machine) -> None:
    late = simulate(machine, replace(SHORT, delay=0.004, link_delay=0.002))
    q, _ = motors(late)
    links = columns(late, "qs")
    assert np.abs(q[10:] - links[8:-2]).max() < 1e-9
    assert np.abs(q[10:] - links[10:]).max() > 1e-4


def test_a_warm_robot_has_other_friction_and_needs_other_currents(machine: Machine) -> None:
    regressors = Regressors(machine.robot)
    settings = replace(SHORT, duration=20.0, further=())
    cold = simulate(machine, settings)
    warm = simulate(machine, replace(settings, constant_drift=-0.2))
    t = cold.columns["t"] / 20.0
    assert np.abs(columns(warm, "i") * (1 - 0.2 * t)[:, None] - columns(cold, "i")).max() < 1e-9
    loose = simulate(machine, replace(settings, friction_drift=-0.5))
    q, tau = motors(loose)
    qd = np.gradient(q, 1e-3, axis=0)
    left = tau.T - regressors.torques(TRUTH, Motion(q.T, qd.T, np.gradient(qd, 1e-3, axis=0).T))
    for k in range(2):
        friction = TRUTH[f"Fv{k + 1}"] * qd[:, k] + TRUTH[f"Fc{k + 1}"] * np.sign(qd[:, k])
        for start, wanted in ((2000, -0.075), (17000, -0.45)):
            part = np.arange(start, start + 2000)
            part = part[np.abs(qd[part, k]) > 0.05]
            found = (left[k, part] @ friction[part]) / (friction[part] @ friction[part])
            assert found == pytest.approx(wanted, abs=0.02)


# -- trajectories -----------------------------------------------------------------------------------------------------


def plan(file: Path, name: str, seed: int = 0, **given: float | str) -> tuple[Task, Reference]:
    kind = trajectories()[name]
    values = {one: setting.default for one, setting in kind.settings.items()} | given
    robot = read(file)
    task = Task(robot, None, {}, False, np.array([0.3, -0.5]), 1e-3, 30000, np.random.default_rng(seed), values)
    return task, kind.plan(task)


#: Trajectories that go where something else says, slowly or as it was recorded.
WITHOUT_LIMITS = {"force_steps", "locked_output", "played"}


def limited() -> Iterator[tuple[str, dict[str, str]]]:
    """The other trajectories, once for each of their words."""
    for name in sorted(trajectories().keys() - WITHOUT_LIMITS):
        words = {key: one.choices for key, one in trajectories()[name].settings.items() if one.choices}
        for chosen in product(*words.values()):
            yield name, dict(zip(words, chosen, strict=True))


@pytest.mark.parametrize(("name", "given"), list(limited()))
def test_references_start_at_rest_and_keep_their_limits(name: str, given: Mapping[str, str], file: Path) -> None:
    for seed in range(3):
        task, reference = plan(file, name, seed, speed=0.8, acceleration=1.7, **given)
        q, qd = reference.q, reference.qd
        qdd = np.diff(qd, axis=0) / task.period
        limits = np.array([[float(end) for end in (one.lower or 0, one.upper or 0)] for one in task.robot.moving])
        assert (q > limits[:, 0]).all()
        assert (q < limits[:, 1]).all()
        assert np.abs(qd[0]).max() < 1e-12
        assert np.abs(qdd[0]).max() < 0.05
        assert np.abs(qd).max() > 0.79 or np.abs(qdd).max() > 1.69
        assert np.abs(qd).max() < 0.80001
        assert np.abs(qdd).max() < 1.70001
        assert np.abs(np.diff(q, axis=0) / task.period - (qd[1:] + qd[:-1]) / 2).max() < 1e-3


def test_many_harmonics_keep_the_limits_too(file: Path) -> None:
    """Between instants at which the series is looked at it is no faster."""
    given: dict[str, float] = {"harmonics": 99, "frequency": 0.02, "acceleration": 2.0, "speed": 1.0}
    for seed in range(5):
        task, reference = plan(file, "fourier", seed, **given)
        acceleration = np.abs(np.diff(reference.qd, axis=0)).max() / task.period
        assert 0.5 < acceleration < 2.0 * 1.001


def test_a_reference_may_hold_still(file: Path, tmp_path: Path) -> None:
    held = Recorded({"t": np.arange(4) / 10, "q1": np.full(4, 0.1), "q2": np.full(4, -0.2)}).save(tmp_path / "held.csv")
    task, _ = plan(file, "fourier")
    reference = trajectories()["played"].plan(replace(task, settings={"file": str(held)}))
    assert reference.q == pytest.approx(np.tile([0.1, -0.2], (len(reference.q), 1)))


def test_a_file_of_few_rows_is_not_played(file: Path, tmp_path: Path) -> None:
    rows = {"t": np.arange(3) / 10, "q1": np.full(3, 0.1), "q2": np.full(3, -0.2)}
    short = Recorded(rows).save(tmp_path / "short.csv")
    task, _ = plan(file, "fourier")
    with pytest.raises(Unplanned, match=r"short.csv has 3 rows, expected 4 at least"):
        trajectories()["played"].plan(replace(task, settings={"file": str(short)}))


def test_a_fourier_series_repeats(file: Path) -> None:
    _, reference = plan(file, "fourier", frequency=0.2)
    assert np.abs(reference.q[5000:] - reference.q[:-5000]).max() < 1e-12


def test_a_trapezoid_takes_the_time_of_its_profile(file: Path) -> None:
    """A way x at speed v and acceleration a takes x/v + v/a from rest to rest."""
    _, reference = plan(file, "point_to_point", profile="trapezoidal", speed=0.5, acceleration=1.0, pause=1.0)
    moving = np.flatnonzero(np.abs(reference.qd).max(axis=1) > 0)
    first = moving[: np.flatnonzero(np.diff(moving) > 1)[0] + 1]
    way = np.abs(reference.q[first[-1] + 1] - reference.q[0]).max()
    assert first[0] == pytest.approx(1000, abs=2)
    assert len(first) * 1e-3 == pytest.approx(way / 0.5 + 0.5, abs=3e-3)


def test_locked_links_stand_still_while_the_drive_trains_show_their_stiffness(machine: Machine) -> None:
    settings = replace(SHORT, flexible=True, trajectory="locked_output", duration=20.0, pose=(0.4, 0.7))
    run = simulate(machine, settings)
    assert np.ptp(columns(run, "qs"), axis=0).max() < 1e-12
    q, tau = motors(run)
    qd = np.gradient(q, 1e-3, axis=0)
    for k in range(2):
        steady = (np.abs(qd[:, k]) > 4e-4) & (run.columns["t"] > 10)
        A = np.stack([q[steady, k], np.sign(qd[steady, k]), np.ones(steady.sum())], 1)
        found = np.linalg.lstsq(A, tau[steady, k], rcond=None)[0]
        assert found[0] == pytest.approx(MOTORS[f"k{k + 1}"], rel=0.02)
        assert found[1] == pytest.approx(MOTORS[f"Fcm{k + 1}"], rel=0.05)


@pytest.fixture(scope="module")
def pressed() -> Iterator[tuple[Machine, Simulated]]:
    settings = Settings(
        trajectory="force_steps",
        trajectory_settings={"steps": 2.0, "force": 3000.0, "contact": "sliding"},
        flexible=True,
        pose=(0.2, -1.2, 1.0, 0.0, 0.7, 0.0),
        duration=15.0,
        further=("qr", "qs"),
    )
    with compiled(read(find_robot("kr500"))) as made:
        yield made, simulate(made, settings)


def test_a_pressed_stop_is_balanced_by_the_drive_trains(pressed: tuple[Machine, Simulated]) -> None:
    """Virtual work: k (q - link) grows by J^T f, with J by differences of the tool's place."""
    machine, run = pressed
    drives = machine.robot.drives
    assert drives is not None
    coupling = np.array([[float(x) for x in row] for row in drives.coupling])
    q = columns(run, "qm") @ np.linalg.inv(coupling).T
    links = columns(run, "qs")
    k = np.array([run.parameters[f"k{j}"] for j in range(1, 7)])
    model = machine.module.Robot("twin_flexible")
    peak = 8900  # at rest on the highest step
    force = np.array([run.columns[name][peak] for name in ("fx", "fy", "fz")])
    assert force[2] == pytest.approx(3000.0, rel=0.15)
    assert np.abs(force[:2]).max() < 0.01 * force[2]
    assert not any(run.columns[name].any() for name in ("mx", "my", "mz"))
    h, pose = 1e-6, model.tool_transform(links[peak])
    J = np.stack(
        [
            (model.tool_transform(links[peak] + h * e)[:3, 3] - model.tool_transform(links[peak] - h * e)[:3, 3])
            / (2 * h)
            for e in np.eye(6)
        ],
        axis=1,
    )
    weight = model.gravity(links[peak]) - model.gravity(links[0])
    wanted = J.T @ pose[:3, :3] @ force + weight
    assert k * ((q - links)[peak] - (q - links)[0]) == pytest.approx(wanted, abs=0.02 * np.abs(wanted).max())


def test_the_tool_keeps_its_orientation_while_it_presses(pressed: tuple[Machine, Simulated]) -> None:
    """Report section 4.2: axis 5 turns by as much as axes 2 and 3 together."""
    _, run = pressed
    moved = columns(run, "qr") - columns(run, "qr")[0]
    peak = int(np.argmax(np.abs(moved[:, 1])))
    assert np.abs(moved[peak, 1]) > 1e-4
    assert np.abs(moved[peak, [0, 3, 5]]).max() < 1e-9
    assert np.abs(moved[peak, 4]) == pytest.approx(np.abs(moved[peak, 1] + moved[peak, 2]), rel=1e-6)


# -- what is refused --------------------------------------------------------------------------------------------------

REFUSED = {
    ("--trajectory", "spiral"): "--trajectory:1:1: there is no trajectory 'spiral', expected one of force_steps, ",
    (
        "--trajectory",
        "locked_output",
    ): "--trajectory:1:1: locked_output needs elastic drive trains, expected --flexible",
    ("--set", "sped=1"): "--set:1:1: trajectory fourier has no setting 'sped', expected frequency=0.1, ",
    (
        "--set",
        "speed=fast",
    ): "--set:1:1: speed is fast, expected a number above 0, largest speed of a joint [rad/s, m/s]",
    ("--set", "harmonics=1"): "--set:1:1: harmonics is 1.0, expected a whole number above 1 and below 100",
    ("--set", "speed"): "--set:1:1: 'speed', expected NAME=VALUE",
    ("--pose", "1"): "--pose:1:1: 1 numbers, expected one for each of 2 joints",
    ("--pose", "1", "9"): "--pose:1:1: joint 2 at 9, expected a position between -2.793 and 2.793",
    ("--parameters", "mine"): "--parameters:1:1: two_links has no parameter set 'mine', expected ",
    ("--duration", "0"): "--duration:1:1: 0, expected a number above 0",
    ("--duration", "1e9"): "--duration:1:1: 1e+12 samples, expected at most 100000000",
    ("--duration", "1e300", "--rate", "1e300"): "--duration:1:1: inf samples, expected at most 100000000",
    ("--rate", "nan"): "--rate:1:1: nan, expected a number above 0",
    ("--log-rate", "300"): "--log-rate:1:1: 300, expected --rate, 1000 Hz, divided by a whole number",
    ("--also", "qx"): "--also:1:1: columns 'qx', expected one of qr, qs, temp",
    ("--noise", "1", "2", "3"): "--noise:1:1: 3 numbers, expected one, or one for each of 2 motors",
    ("--noise", "-1"): "--noise:1:1: -1, expected a number that is not negative",
    ("--noise", "1e308"): "--noise:1:1: 1e+308, expected a number that is not negative, 1e+12 at most",
    ("--temperature", "1e308"): "--temperature:1:1: 1e+308, expected a number above 0, 1e+12 at most",
    ("--temperature-rise", "1e308"): "--temperature-rise:1:1: 1e+308, expected a number that is not negative, 1e+12",
    ("--warm-up", "1e-320"): "--warm-up:1:1: 9.99989e-321, expected a number above 1e-09",
    ("--resolution", "x"): "counterpoise simulate:1:1: argument --resolution: invalid float value: 'x'",
    ("--delay", "1e300"): "--delay:1:1: 1e+300 s, expected no more than the run, 20 s",
    ("--delay", "1.5e-3"): "--delay:1:1: 0.0015 s, 1.5 samples, expected a whole number of samples of 0.001 s",
    (
        "--link-delay",
        "1e-4",
        "--also",
        "qs",
    ): "--link-delay:1:1: 0.0001 s, 0.1 samples, expected a whole number of samples of 0.001 s",
    ("--delay", "-1"): "--delay:1:1: -1, expected a number that is not negative",
    ("--link-delay", "1e-3"): "--link-delay:1:1: no encoders of the links are logged, expected --also qs",
    ("--friction-drift", "-1"): "--friction-drift:1:1: -1, expected a number above -1",
    ("--seed", "-1"): "--seed:1:1: -1, expected a whole number from 0 on",
    ("--out", "run.mat"): "--out:1:1: a file that ends in '.mat', expected one that ends in .csv",
}


@pytest.mark.parametrize("words", REFUSED, ids=" ".join)
def test_bad_options_are_refused(words: tuple[str, ...], file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    done = command("simulate", file, *words, capsys=capsys)
    assert done.status == 2
    assert done.err.startswith(f"error: {REFUSED[words]}")


def test_what_only_the_plan_or_the_motion_shows_is_refused(machine: Machine) -> None:
    for changes, message in (
        ({"trajectory": "force_steps"}, "keeps the tool's orientation, which 2 joints cannot, expected 6"),
        ({"pose": (0.0, 2.79)}, "joint 2 is too near to its limit"),
        ({"trajectory_settings": {"frequency": 90.0}}, "the highest harmonic is too fast"),
        ({"flexible": True, "parameters": "twin"}, "without inertia"),
        ({"bandwidth": 1000.0, "delay": 0.02}, "the motion is not finite any more"),
    ):
        with pytest.raises(InputError, match=message):
            simulate(machine, replace(SHORT, **changes))


def test_a_robot_without_elastic_drive_trains_is_not_flexible() -> None:
    with pytest.raises(InputError, match="puma560 has no elastic drive trains"):
        check(Settings(flexible=True), read(find_robot("puma560")))


@pytest.mark.parametrize(
    ("effect", "what"),
    [
        ("dahl_friction, joint: 2, values: {xs: 1 mrad}", "effect dahl_friction reads a state of its own"),
        ("warm_friction, joint: 2", "effect warm_friction reads the drive's warmth"),
    ],
)
def test_an_effect_that_is_not_simulated_is_named_in_its_line(
    effect: str, what: str, file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "two_links.yaml"
    path.write_text(file.read_text().replace("effects:\n", f"effects:\n  - {{effect: {effect}}}\n"))
    line = path.read_text().splitlines().index(f"  - {{effect: {effect}}}") + 1
    done = command("simulate", path, "--parameters", "twin", "--out", tmp_path / "run.csv", capsys=capsys)
    expected = f"two_links.yaml:{line}:14: {what}, which is not simulated, expected effects of q, qd and qdd alone"
    assert done.status == 2
    assert done.err.splitlines()[-1].endswith(expected)


def test_a_saturated_current_stays_at_its_limit(machine: Machine) -> None:
    run = simulate(machine, replace(SHORT, largest=(1.0, 0.5)))
    current = np.abs(columns(run, "i")).max(axis=0)
    assert (current <= np.array([1.0, 0.5]) + 1e-9).all()


def test_slow_controllers_rest_for_a_sample_at_least(machine: Machine) -> None:
    slow = replace(SHORT, rate=0.4, duration=10.0, trajectory="point_to_point", bandwidth=0.01)
    assert len(simulate(machine, slow).columns["t"]) == 4
