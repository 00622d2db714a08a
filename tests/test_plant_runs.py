"""Runs of the simulated robot of ``tests/plant``: control, sensors, run files, robot files."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import scipy.signal

from tests.commands import command
from tests.plant.effect import Effect
from tests.plant.known_effects import textbook
from tests.plant.machine import Machine
from tests.plant.measurement import Sensors
from tests.plant.robot import Array, Robot
from tests.plant.robot_file import PRIOR, robot_file
from tests.plant.robots import ROBOTS
from tests.plant.run import Run, write_csv
from tests.plant.simulate import Controller, make_run, own_effects
from tests.plant.size import effect_torque, torque_with, whitened_size
from tests.plant.trajectories.fourier import fourier
from tests.plant.trajectories.point_to_point import point_to_point
from tests.plant.trajectories.sweeps import slow_reversals, speed_sweeps
from tests.plant.trajectory import Trajectory

ARM = ROBOTS["three_axis"]
SHORT = fourier(3, period=5.0, periods=2, harmonics=4)
QUIET = Sensors(noise=0.0)


@pytest.fixture(params=sorted(ROBOTS))
def robot(request: pytest.FixtureRequest) -> Robot:
    return ROBOTS[request.param]


@pytest.fixture(scope="module")
def run() -> Run:
    return make_run(ARM, fourier(1, period=5.0, periods=8), seed=3)


WAYS = {
    "fourier": SHORT,
    "trapezoid": point_to_point(1, 8.0),
    "smooth": point_to_point(2, 8.0, smooth=True),
    "sweeps": speed_sweeps(2, duration=12.0),
    "slow": slow_reversals(4, 5.0, 2),
}


@pytest.mark.parametrize("way", WAYS)
def test_references_keep_the_limits_and_their_speed_is_the_slope(robot: Robot, way: str) -> None:
    rate = 1000.0
    q, qd = WAYS[way].sample(robot, rate)
    low, high, speed, acceleration = np.array([joint.range for joint in robot.chain]).T
    assert np.all((low <= q) & (q <= high))
    assert np.all(np.abs(qd) <= speed)
    assert np.all(np.abs(np.diff(qd, axis=0)) * rate <= acceleration * 1.001)
    between = 0.5 * (qd[1:] + qd[:-1]) / rate
    np.testing.assert_allclose(np.diff(q, axis=0), between, atol=2e-6 * np.max(np.abs(high - low)))
    moved = np.ptp(q, axis=0) > 0
    assert np.count_nonzero(moved) == (1 if way == "sweeps" else robot.joints)


@pytest.mark.parametrize("way", WAYS)
def test_the_loop_tracks(robot: Robot, way: str) -> None:
    played = make_run(robot, WAYS[way], sensors=QUIET)
    error = np.max(np.abs(played.q - played.reference), axis=0)
    low, high, *_ = np.array([joint.range for joint in robot.chain]).T
    assert np.all(error < 0.02 * (high - low))
    assert np.all(np.abs(played.i) < 0.99 * robot.column("peak"))


def test_a_logged_current_is_that_of_the_logged_instant(robot: Robot) -> None:
    played = make_run(robot, fourier(2, period=5.0, periods=2), sensors=Sensors(noise=0.02))
    truth, machine = played.truth, played.machine
    needed = machine.rigid_torques(truth.q, truth.qd, truth.qdd)
    for k, effect in enumerate(machine.torques):
        needed += np.outer(truth.torque[:, k], effect.along(robot))
    left = np.sqrt(np.mean((torque_with(played) - needed) ** 2, axis=0))
    assert np.all(left < 0.02 * played.torque_noise)


def spectral_slopes(x: Array, rate: float, cut: float) -> list[Array]:
    """A periodic signal (T x n) up to ``cut`` [Hz], its first and its second derivative."""
    f = np.fft.rfftfreq(len(x), 1 / rate)[:, None]
    lines = np.fft.rfft(x, axis=0) * (f < cut)
    return [np.fft.irfft(lines * (2j * np.pi * f) ** k, len(x), axis=0) for k in range(3)]


def test_a_robot_without_hidden_effects_is_its_textbook_model(robot: Robot) -> None:
    """From logged positions alone, with sign(qd) for friction; rows near standstill are masked, as a diagnosis does."""
    played = make_run(robot, fourier(5, periods=2), sensors=Sensors(noise=1e-9))
    q, qd, qdd = spectral_slopes(played.q, played.rate, 100.0)
    model = played.machine.rigid_torques(q, qd, qdd)
    laws = played.machine.law_torques(q, qd, 1 / played.rate)
    slow = np.zeros(q.shape, dtype=bool)
    for k, effect in enumerate(played.machine.torques):
        along, torque = effect.along(robot), laws[:, k]
        if effect.law in ("coulomb", "wrist_friction"):
            speed = qd @ along
            viscous = speed / effect.value("speed", robot) if effect.law == "wrist_friction" else 0.0
            torque = effect.amount(robot) * (np.sign(speed) + viscous)
            slow |= (np.abs(speed) < 0.04 * np.max(np.abs(speed)))[:, None] & (along != 0)
        model += np.outer(torque, along)
    low_pass = scipy.signal.butter(4, 20.0, fs=played.rate)
    left = scipy.signal.filtfilt(*low_pass, np.tile(played.tau - model, (3, 1)), axis=0)[len(q) : 2 * len(q)]
    assert played.noise is not None
    passed = np.mean(played.noise.shape(np.linspace(0, 20.0, 500))) * 20.0
    noise = played.torque_noise * 0.02 / 1e-9 * np.sqrt(passed)
    for j in range(robot.joints):
        kept = np.convolve(slow[:, j], np.ones(51), "same") == 0
        assert np.mean(kept) > 0.6
        assert np.sqrt(np.mean(left[kept, j] ** 2)) < 0.05 * noise[j]


def test_periods_differ_by_noise_alone(run: Run) -> None:
    rows = run.period
    assert rows == 2500
    periods = run.i.reshape(8, rows, -1)
    clean = run.truth.current.reshape(8, rows, -1)
    assert run.noise is not None
    for before, after in pairwise(range(8)):
        assert np.all(np.std(clean[after] - clean[before], axis=0) < 0.02 * run.noise.std)
    spread = np.std(periods - np.mean(periods, axis=0), axis=(0, 1)) * np.sqrt(8 / 7)
    np.testing.assert_allclose(spread, run.noise.std, rtol=0.05)
    lines = np.abs(np.fft.rfft(run.truth.current, axis=0))
    between = np.ones(len(lines), dtype=bool)
    between[::8] = False
    assert np.max(lines[between]) < 1e-3 * np.max(lines[1:])


def test_the_noise_has_the_spectrum_that_is_stated() -> None:
    still = Trajectory(
        lambda robot, t: (np.tile(robot.centre, (len(t), 1)), np.zeros((len(t), robot.joints))), 200.0, 0.5
    )
    level = (0.01, 0.02, 0.04)
    played = make_run(ARM, still, seed=5, sensors=Sensors(noise=level, colour=(0.6, 12.0)))
    assert played.noise is not None
    rms = np.sqrt(np.mean(played.truth.current**2, axis=0))
    np.testing.assert_allclose(played.noise.std, np.array(level) * rms, rtol=1e-12)
    noise = (played.i - played.truth.current) / played.noise.std
    np.testing.assert_allclose(np.std(noise, axis=0), 1.0, rtol=0.02)
    parts = noise.reshape(200, -1, ARM.joints)
    density = np.mean(np.abs(np.fft.rfft(parts, axis=1)) ** 2, axis=(0, 2)) * 2 / (parts.shape[1] * played.rate)
    f = np.fft.rfftfreq(parts.shape[1], 1 / played.rate)
    for low, high in ((3, 8), (8, 20), (20, 60), (60, 150), (150, 245)):
        band = (f >= low) & (f < high)
        assert np.mean(density[band]) == pytest.approx(np.mean(played.noise.shape(f[band])), rel=0.05)
    fine = np.linspace(0, played.rate / 2, 20001)[:-1]
    assert np.mean(played.noise.shape(fine)) * played.rate / 2 == pytest.approx(1.0, rel=1e-3)


def test_encoders_have_steps() -> None:
    coarse = replace(ARM, encoder_bits=14)
    played = make_run(coarse, SHORT, sensors=Sensors(noise=0.0, link_encoders=3, link_bits=16))
    step = 2 * np.pi / 2**14
    np.testing.assert_allclose(played.qm / step, np.rint(played.qm / step), atol=1e-6)
    angle = played.truth.q @ coarse.ratios.T
    assert 0.4 * step < np.max(np.abs(played.qm - angle)) <= 0.5001 * step
    assert played.qs is not None
    assert np.max(np.abs(played.qs - played.truth.q)) <= np.pi / 2**16 * 1.0001


def test_late_readings_are_the_past() -> None:
    delay = 3.3e-3
    effects = [Effect("delay", size=delay), Effect("link_latency", size=2 * delay)]
    late = make_run(ARM, SHORT, effects, sensors=Sensors(noise=0.0, quantised=False, link_encoders=3, link_bits=40))
    plain = make_run(ARM, SHORT, sensors=Sensors(noise=0.0, quantised=False))
    fine = make_run(
        ARM, SHORT, sensors=Sensors(noise=0.0, quantised=False), controller=Controller(rate=2000.0, log_rate=2000.0)
    )
    np.testing.assert_array_equal(late.i, plain.i)
    assert late.qs is not None
    for column in range(ARM.joints):
        past = np.interp(late.t[10:] - delay, fine.t, fine.q[:, column])
        np.testing.assert_allclose(late.q[10:, column], past, atol=2e-6)
        past = np.interp(late.t[10:] - 2 * delay, fine.t, fine.q[:, column])
        np.testing.assert_allclose(late.qs[10:, column], past, atol=2e-6)


def test_amplifiers_clip() -> None:
    whole = make_run(ARM, SHORT, sensors=QUIET)
    clipping = Effect("current_saturation", 2, 0.72)
    played = make_run(ARM, SHORT, [clipping], sensors=QUIET)
    limit = ARM.chain[1].peak * 0.28
    assert np.max(np.abs(whole.truth.current[:, 1])) > 1.1 * limit
    assert np.max(np.abs(played.truth.current[:, 1])) <= limit * (1 + 1e-12)
    np.testing.assert_array_equal(played.i[:, 1], played.truth.command[:, 1])
    assert np.max(np.abs(played.i[:, 1])) > 1.05 * limit
    assert whitened_size(make_run(ARM, SHORT, [clipping]), effect_torque(played, clipping), joints=[2]) > 0.5


def test_shorter_steps_of_integration_change_nothing_that_is_seen() -> None:
    effects = [Effect("joint_flexibility", 2), Effect("stribeck", 1), Effect("hysteresis", 3)]
    usual, fine = (
        make_run(ARM, SHORT, effects, controller=Controller(longest_step=step)) for step in (1.25e-4, 2.5e-5)
    )
    assert usual.steps == 4
    assert fine.steps == 20
    assert whitened_size(usual, torque_with(usual) - torque_with(fine), limit=20.0) < 0.03
    assert np.max(np.abs(usual.truth.q - fine.truth.q)) < 2e-6


def test_it_is_the_same_for_the_same_seed() -> None:
    effects = [Effect("ripple_motor", 3), Effect("joint_flexibility", 2)]
    first, again, other = (make_run(ARM, SHORT, effects, seed=seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(first.i, again.i)
    np.testing.assert_array_equal(first.qm, again.qm)
    np.testing.assert_array_equal(first.qm, other.qm)
    assert np.all(np.std(first.i - other.i, axis=0) > 0)


def test_warm_up_is_seen_in_friction_and_in_the_thermometer() -> None:
    warm = Effect("warm_up", 2, 0.5)
    cold, later = (
        make_run(ARM, SHORT, [warm], sensors=Sensors(temperature=True), start_time=start) for start in (0.0, 3600.0)
    )
    ratio = effect_torque(cold, warm)[:, 1] / cold.truth.friction[:, 1]
    moving = np.abs(cold.truth.qd[:, 1]) > 0.1
    fading = 0.5 * (0.6 * np.exp(-cold.t / 25) + 0.4 * np.exp(-cold.t / 400))
    np.testing.assert_allclose(ratio[moving], fading[moving], rtol=1e-3)
    assert np.max(np.abs(effect_torque(later, warm))) < 0.01 * np.max(np.abs(effect_torque(cold, warm)))
    assert cold.temperature is not None
    assert later.temperature is not None
    assert np.all(cold.temperature[0] < 1)
    assert np.all(later.temperature[0] > 24)


def test_run_files_hold_what_was_logged(tmp_path: Path) -> None:
    played = make_run(ROBOTS["small_wrist"], SHORT, sensors=Sensors(link_encoders=6, temperature=True))
    write_csv(played, tmp_path / "A.csv", reference=True)
    header = (tmp_path / "A.csv").read_text().splitlines()[0].split(",")
    each = [f"{name}{j}" for name in ("qm", "i", "qs", "qr", "temp") for j in range(1, 7)]
    assert header == ["t", *each]
    table = np.genfromtxt(tmp_path / "A.csv", delimiter=",", names=True)
    assert len(table) == 5000
    np.testing.assert_allclose(np.diff(table["t"]), 0.002, atol=1e-12)
    np.testing.assert_allclose(table["i5"], played.i[:, 4], rtol=1e-10)
    # Motor 6 turns with the sum of axes 5 and 6.
    np.testing.assert_allclose(table["qm6"], 32 * (played.q[:, 4] + played.q[:, 5]), atol=1e-9)
    write_csv(played, tmp_path / "B.csv", "q", "tau")
    table = np.genfromtxt(tmp_path / "B.csv", delimiter=",", names=True)
    constant = 0.06 * 32
    np.testing.assert_allclose(table["tau6"], constant * played.i[:, 5], rtol=1e-9)
    np.testing.assert_allclose(table["tau5"], 0.06 * 45 * played.i[:, 4] + constant * played.i[:, 5], rtol=1e-9)
    with pytest.raises(ValueError, match="expected qm or q"):
        write_csv(played, tmp_path / "C.csv", "x")


def test_robot_files_are_accepted_and_mean_the_same_robot(
    robot: Robot, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"{robot.name}.yaml"
    path.write_text(robot_file(robot))
    q, qd, qdd = np.random.default_rng(4).uniform(0.1, 1, (3, 1, robot.joints))
    words = [
        word for name, x in (("q", q), ("qd", qd), ("qdd", qdd)) for word in (f"--{name}", *map(repr, x[0].tolist()))
    ]
    done = command("evaluate", path, "inverse_dynamics", "--parameters", PRIOR, *words, capsys=capsys)
    assert done.status == 0, done.err
    machine = Machine(robot, own_effects(robot))
    expected = machine.rigid_torques(q, qd, qdd)[0]
    torques = machine.law_torques(np.repeat(q, 2, axis=0), np.repeat(qd, 2, axis=0), 1.0)[-1]
    for effect, torque in zip(machine.torques, torques, strict=True):
        expected += torque * effect.along(robot)
    np.testing.assert_allclose(json.loads(done.out)["tau"], expected, rtol=1e-9, atol=1e-9)


def test_robot_files_hold_further_effects_by_the_textbooks_law(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    laws = {"cable_spring": 1, "stribeck": 1, "gradual_rise": 2, "position_friction": 3}
    exact = {"quadratic_viscous": 2, "asymmetric_coulomb": 3}
    known = [Effect(law, joint) for law, joint in {**laws, **exact}.items()]
    path = tmp_path / "arm.yaml"
    path.write_text(robot_file(ARM, known=known))
    q, qd, qdd = np.random.default_rng(4).uniform(0.1, 1, (3, 1, ARM.joints))
    words = [
        word for name, x in (("q", q), ("qd", qd), ("qdd", qdd)) for word in (f"--{name}", *map(repr, x[0].tolist()))
    ]
    done = command("evaluate", path, "inverse_dynamics", "--parameters", PRIOR, *words, capsys=capsys)
    assert done.status == 0, done.err
    simple = [effect for effect in own_effects(ARM) if effect not in ARM.own]
    machine = Machine(ARM, (*simple, *(effect for effect in known if effect.law in exact)))
    expected = machine.rigid_torques(q, qd, qdd)[0]
    torques = machine.law_torques(np.repeat(q, 2, axis=0), np.repeat(qd, 2, axis=0), 1.0)[-1]
    for effect, torque in zip(machine.torques, torques, strict=True):
        expected += torque * effect.along(ARM)
    for effect in known:
        if effect.law in laws:
            torque_of_law = textbook(effect, ARM, q, qd)
            assert torque_of_law is not None
            expected += torque_of_law[0] * effect.along(ARM)
    np.testing.assert_allclose(json.loads(done.out)["tau"], expected, rtol=1e-9, atol=1e-9)
