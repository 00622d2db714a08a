"""A torque that lacks what is quick beside its positions is no sign of an elastic drive train, nor of play."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy import signal

from identification import filtering
from identification.diagnosis.candidates import backlash, elasticity
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NAMED, NOTHING
from identification.diagnosis.noise import torque_band
from identification.diagnosis.noise.torque_band import end, notes
from identification.diagnosis.runs.scene import Scene
from tests.diagnosis.diagnosed import CLEAN, Known, known
from tests.diagnosis.diagnosed_arm import answered
from tests.plant.effect import Effect
from tests.plant.robot import Array
from tests.plant.robot_file import robot_file
from tests.plant.robots import ROBOTS
from tests.plant.run import write_csv
from tests.plant.simulate import make_run
from tests.plant.trajectories.fourier import fourier

ARM, CUTOFF = "three_axis", 10.0
WAY = fourier(1, period=5.0, periods=2)
#: Of a motor's encoder [rad].
STEP = 1e-2


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return known(ROBOTS[ARM], tmp_path_factory.mktemp("robots"))


def slow(one: Scene, joints: slice = slice(None)) -> Scene:
    """With torques of ``joints`` (from 0) of which a filter took what is quick, in their phase."""
    tau = one.tau.copy()
    tau[joints] = low_passed(tau[joints], one.sampled.run.rate)
    return replace(one, sampled=replace(one.sampled, tau=tau))


def low_passed(x: Array, rate: float) -> Array:
    return np.asarray(signal.filtfilt(*signal.butter(2, CUTOFF, fs=rate), x))


def coarse(one: Scene) -> Scene:
    """With accelerations of positions in steps of half a milliradian."""
    step, sampled = 5e-4, one.sampled
    q = filtering.smoothed(step * np.round(one.motion.q / step), 4, 50.0, sampled.run.rate)
    qdd = one.derivative(one.derivative(q))
    return replace(one, sampled=replace(sampled, motion=replace(one.motion, qdd=qdd)))


def scene(arm: Known, *hidden: Effect) -> Scene:
    """Of a run without noise beside the true model."""
    return arm.scene(make_run(arm.robot, WAY, hidden, sensors=CLEAN))


def test_torques_reach_as_far_as_the_positions_ask(arm: Known) -> None:
    assert end([scene(arm)]) == np.inf
    assert notes([scene(arm)]) == []


@pytest.mark.parametrize("change", [slow, coarse])
def test_the_band_of_the_torques_ends(arm: Known, change: Callable[[Scene], Scene]) -> None:
    one = change(scene(arm))
    assert CUTOFF / 2 < end([one]) < 2 * CUTOFF
    assert elasticity.hypotheses([one]) == backlash.hypotheses([one]) == []
    assert len(notes([one])) == 1


def test_three_joints_of_four_say_where_the_band_ends(tmp_path: Path) -> None:
    """What is quick on the fourth is noise."""
    one = slow(scene(known(ROBOTS["scara_like"], tmp_path)))
    assert len(one.tau) == 4
    tau = one.tau.copy()
    tau[2] += np.std(tau[2]) * np.random.default_rng(1).normal(size=tau.shape[1])
    assert CUTOFF / 2 < end([replace(one, sampled=replace(one.sampled, tau=tau))]) < 2 * CUTOFF


@pytest.mark.parametrize("hidden", [Effect("joint_flexibility", 2, 1.1e-5), Effect("backlash", 2, 3e-4)])
def test_an_elastic_drive_train_ends_no_band(arm: Known, hidden: Effect) -> None:
    assert end([scene(arm, hidden)]) == np.inf


def test_of_one_joint_alone_what_is_less_than_a_rotor_is_no_drive_train(arm: Known) -> None:
    def only(one: Scene) -> Scene:
        return replace(one, sampled=replace(one.sampled, tau=one.tau[1:2]))

    def band(one: Scene) -> float:
        return end([only(one)])

    noisy = scene(arm)
    noise = 1e-3 * np.std(noisy.tau) * np.random.default_rng(1).normal(size=noisy.tau.shape)
    noisy = replace(noisy, sampled=replace(noisy.sampled, tau=noisy.tau + noise))
    assert band(noisy) == band(scene(arm, Effect("joint_flexibility", 2, 1.1e-5))) == np.inf
    assert CUTOFF / 2 < band(slow(noisy)) < 3 * CUTOFF


@pytest.mark.parametrize(("lifted", "ends"), [(1.5, True), (8.0, False)])
def test_a_filter_lifts_nothing(lifted: float, ends: bool, arm: Known, monkeypatch: pytest.MonkeyPatch) -> None:
    """A link on a spring asks for more below the frequency beyond which it hardly moves with its motor."""
    one = scene(arm)
    alone = replace(one, sampled=replace(one.sampled, tau=one.tau[:1]))
    power = np.concatenate([np.ones(20), np.full(5, lifted), np.geomspace(1.0, 0.01, 25)])
    monkeypatch.setattr(torque_band, "_power", lambda *_: power)
    assert np.isfinite(end([alone])) == ends


def test_of_two_joints_the_lifted_one_swings(arm: Known, monkeypatch: pytest.MonkeyPatch) -> None:
    """However much more of the slow torque the other one has."""
    one = scene(arm)
    both = replace(one, sampled=replace(one.sampled, tau=one.tau[:2]))
    ends, lifted = np.geomspace(1.0, 0.003, 25), np.repeat([0.6, 2.2], [20, 5])
    powers = [np.concatenate([start, ends]) for start in (np.full(25, 2.0), lifted)]
    monkeypatch.setattr(torque_band, "_power", lambda scenes, errors, k, *_: powers[k])
    assert end([both]) == np.inf
    powers[1] = powers[0]
    assert np.isfinite(end([both]))


def test_joints_that_stand_do_not_count(arm: Known, monkeypatch: pytest.MonkeyPatch) -> None:
    """Three more, as of a wrist that is held."""
    one = slow(scene(arm)).sampled
    left_out, tau = (
        np.concatenate([x, more(x)]) for x, more in ((one.left_out, np.ones_like), (one.tau, np.zeros_like))
    )
    held = replace(scene(arm), sampled=replace(one, left_out=left_out, tau=tau))
    # The model's torque on joints that stand is of no account.
    assert CUTOFF / 2 < end([held]) < 2 * CUTOFF
    assert end([replace(held, sampled=replace(held.sampled, left_out=np.ones_like(left_out)))]) == np.inf


@pytest.mark.parametrize("rates", [(1000.0, 80.0), (80.0, 1000.0)])
def test_frequencies_are_those_of_each_run(rates: tuple[float, float]) -> None:
    """Noise about 10 Hz in runs at 50 and 40 rows a second is there in both."""
    draw, scenes = np.random.default_rng(1), []
    for rate in rates:
        band = signal.butter(2, (9.5, 10.5), "band", fs=rate, output="sos")
        sampled = SimpleNamespace(run=SimpleNamespace(rate=rate), left_out=np.zeros((1, round(60 * rate)), dtype=bool))
        scenes.append((SimpleNamespace(sampled=sampled), signal.sosfilt(band, draw.normal(size=round(60 * rate)))))
    frequency = np.linspace(2.0, 20.0, 181)
    each: list[Any] = [one for one, _ in scenes]
    density = torque_band._density(each, [x for _, x in scenes], 0, frequency)
    peaks = frequency[signal.argrelmax(density)]
    assert peaks == pytest.approx([10.0] * len(peaks), abs=0.5)


def test_what_one_joint_lacks_may_be_its_drive_train(arm: Known) -> None:
    assert end([slow(scene(arm), slice(1, 2))]) == np.inf


@pytest.mark.long
def test_a_filter_is_not_taken_for_an_elastic_drive_train(tmp_path: Path) -> None:
    """What the filter took of the jumps of friction is missing all the same, and stays unexplained."""
    sources = [str(tmp_path / f"{seed}.csv") for seed in (1, 2)]
    for seed, source in enumerate(sources, 1):
        run = make_run(ROBOTS[ARM], fourier(seed, period=5.0, periods=4), seed=seed)
        run = replace(run, i=low_passed(run.i.T, run.rate).T)
        write_csv(run, Path(source))
    path = tmp_path / "arm.yaml"
    path.write_text(robot_file(ROBOTS[ARM]), encoding="utf-8")
    found, _ = answered(path, Request(sources), tmp_path / "out")
    assert not {"joint_elasticity", "backlash"} & {one.hypothesis.effect for one in found.findings}
    assert any("elasticity and backlash of drive trains are not looked for" in note for note in found.notes)


@pytest.mark.long
@pytest.mark.parametrize(
    ("hidden", "effects"),
    [
        pytest.param([], [], id="rigid"),
        pytest.param([Effect("joint_flexibility", 2, 1.1e-5)], [("joint_elasticity", 2)], id="elastic"),
    ],
)
def test_coarse_encoders_hide_no_elastic_drive_train(
    hidden: list[Effect], effects: list[tuple[str, int]], tmp_path: Path
) -> None:
    """What their steps ask for is known: it is neither a torque that is missing nor an elastic drive train."""
    sources = [str(tmp_path / f"{seed}.csv") for seed in (1, 2)]
    for seed, source in enumerate(sources, 1):
        run = make_run(ROBOTS[ARM], fourier(seed, period=5.0, periods=4), hidden, seed=seed)
        write_csv(replace(run, qm=STEP * np.round(run.qm / STEP)), Path(source))
    path = tmp_path / "arm.yaml"
    path.write_text(robot_file(ROBOTS[ARM]), encoding="utf-8")
    found, _ = answered(path, Request(sources), tmp_path / "out")
    assert [one.hypothesis.key for one in found.findings] == effects
    assert found.verdict == (NAMED if effects else NOTHING)
