"""Drift of a torque constant, from what is recorded to what the robot file then says, without any noise."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.robot.description import Robot
from generator.robot.readers import read
from identification import corrections
from identification.dataset import load
from identification.diagnosis.candidates import library, torque_drift, torque_gain
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.hypothesis import DRIVE, EFFECT, Hypothesis
from identification.diagnosis.columns.warming import following, warm_up_times
from identification.diagnosis.diagnosis import diagnose
from identification.diagnosis.mending.addition import Addition, addition
from identification.diagnosis.mending.refit import refit
from identification.diagnosis.mending.repair import repaired
from identification.diagnosis.mending.writable import writable
from identification.diagnosis.noise.may_act import without_record
from identification.diagnosis.results import document
from identification.diagnosis.runs.played import Player, play
from identification.diagnosis.runs.prepared import Prepared, prepared
from identification.diagnosis.runs.roles import Roles
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.search.loop import search
from identification.diagnosis.verdict import remarks
from identification.diagnosis.verdict.confirmation import confirmed
from identification.diagnosis.verdict.trial import along
from identification.drive_train import coupling, supplied
from identification.observation import Regressors
from identification.recipes import Recipe
from tests.recorded import TRUTH, TWO_LINKS, Recorded, recorded, two_links

Array = NDArray[np.float64]

RISE = 30.0


@dataclass(frozen=True)
class Drift:
    """Of motor 2: true torque = ``gain`` (1 + ``drift`` w) recorded, w = 1 - exp(-t/``time``); without a time it comes
    and goes once a minute. The drive was cold ``before`` [s] the run.
    """

    drift: float
    time: float = 20.0
    gain: float = 1.0
    before: float = 0.0

    def warmth(self, t: Array) -> Array:
        return np.asarray(1 - np.exp(-(t + self.before) / self.time) if self.time else np.sin(np.pi * t / 60) ** 2)


def logged(folder: Path, seed: int, drift: Drift, temperatures: Sequence[int] = (), seconds: float = 60.0) -> str:
    """The run's file, with the temperatures of some joints, which rise with w."""
    of = two_links(folder)
    run = recorded(of, TRUTH, seconds, 200.0, seed).columns
    warmth = drift.warmth(run["t"])
    N = coupling(of.model.robot)
    motor = np.linalg.solve(N.T, np.stack([run["tau1"], run["tau2"]]))
    motor[1] /= drift.gain * (1 + drift.drift * warmth)
    tau1, tau2 = N.T @ motor
    temps = {f"temp{joint}": 300 + RISE * warmth for joint in temperatures}
    path = folder / f"{seed}{'t' * len(temps)}.csv"
    return str(Recorded({**run, "tau1": tau1, "tau2": tau2, **temps}).save(path))


def heated(folder: Path, seed: int, square: float, w: float = 0.0) -> str:
    """The run's file, of a motor 2 that in 12 s gets warm by the square of its torque in parts of ``square`` [N2 m2],
    and whose constant is lower by 0.3 then. It begins with a warmth ``w``.
    """
    of = two_links(folder)
    run = recorded(of, TRUTH, 60.0, 200.0, seed).columns
    N = coupling(of.model.robot)
    motor = np.linalg.solve(N.T, np.stack([run["tau1"], run["tau2"]]))
    for k, true in enumerate(motor[1].tolist()):
        motor[1, k] = true / (1 - 0.3 * w)
        w += (motor[1, k] ** 2 / square - w) / 200 / 12
    tau1, tau2 = N.T @ motor
    return str(Recorded({**run, "tau1": tau1, "tau2": tau2}).save(folder / f"{seed}.csv"))


def ready(source: str, regressors: Regressors) -> Prepared:
    return prepared(load(source, regressors.model.robot, resting=True), Recipe(), regressors)


def gap(run: Prepared, known: Sequence[Prepared], regressors: Regressors) -> float:
    """Norm of what the model leaves of a run [N m], with parameters from others."""
    fit = refit([one.sampled for one in known], regressors)
    each = play(run, Player(regressors), fit.values).residuals.per_joint
    return float(np.linalg.norm([each[k].norm for k in each]))


def mended(sources: Sequence[str], before: Regressors) -> tuple[dict[str, float], Robot, float]:
    """What a diagnosis tells of the one drift of motor 2, the robot that it writes, and the part of the gap to the last
    run that is left with it.
    """
    *runs, last = (ready(source, before) for source in sources)
    roles = Roles(tuple(sources[:1]), tuple(sources[1:2]), tuple(sources[2:]), tuple(sources[:2]))
    found = diagnose(before, runs, roles)
    (one,) = found.findings
    assert (one.hypothesis.effect, one.joints) == ("torque_drift", (2,))
    told = {name: value["value"] for name, value in document(found)["findings"][0]["parameters"].items()}
    values = {name: value.value for name, value in one.parameters.items() if value.value is not None}
    robot = repaired(TWO_LINKS, "x", [addition(one.hypothesis, one.shape, values)]).robot
    after = Regressors(robot)
    *known, test = (ready(source, after) for source in sources)
    return told, robot, gap(test, known, after) / gap(last, runs, before)


@pytest.mark.parametrize(
    "drift",
    [
        Drift(-0.3),
        Drift(-0.15, gain=0.8),
        Drift(0.2),
    ],
    ids=str,
)
@pytest.mark.long
def test_a_large_drift_is_found_and_written_as_it_is(drift: Drift, tmp_path: Path) -> None:
    told, robot, left = mended([logged(tmp_path, seed, drift) for seed in (1, 2, 3)], two_links(tmp_path))
    assert told["torque_drift2"] == pytest.approx(drift.drift, rel=0.05)
    assert told["warm_up_time"] == pytest.approx(drift.time, rel=0.05)
    assert 1 + told["start2"] == pytest.approx(drift.gain, rel=0.05)
    assert robot.drives is not None
    signals = robot.signals
    written = [float(part[1]) for part in (robot.drives.torque_drift, signals.torque_gain, signals.warm_up_time)]
    assert written == pytest.approx([told["torque_drift2"], 1 + told["start2"], told["warm_up_time"]], rel=1e-5)
    assert left < 0.05


def test_a_drift_by_heat_is_found_and_written_as_it_is(tmp_path: Path) -> None:
    told, robot, left = mended([heated(tmp_path, seed, 0.3) for seed in (1, 2, 3)], two_links(tmp_path))
    assert told["torque_drift2"] / told["warm_torque"] ** 2 == pytest.approx(-0.3 / 0.3, rel=0.05)
    assert told["warm_up_time"] == pytest.approx(12.0, rel=0.05)
    assert float(robot.signals.warm_torque[1]) == pytest.approx(told["warm_torque"], rel=1e-5)
    assert float(robot.signals.warm_torque[0]) == corrections.NEVER
    assert left < 0.05


@pytest.mark.long
def test_how_warm_a_drive_was_when_a_run_began_is_of_that_run_alone(tmp_path: Path) -> None:
    of, warm = two_links(tmp_path), (0.8, 0.0, 0.4)
    runs = [ready(heated(tmp_path, seed, 0.3, w), of) for seed, w in enumerate(warm, 1)]
    found = search(runs, (0, 1), (2,), of)
    (one,) = found.choices
    variant = one.evidence.variant
    assert variant.key == ("torque_drift", 2)
    names = [each.name for each in variant.coefficients]
    told = dict(zip(names, one.evidence.coefficients, strict=True))
    per_square = variant.shape["warm_torque"] ** 2 / 0.3
    assert told["torque_drift2"] / per_square == pytest.approx(-0.3, rel=0.05)
    assert told.get("start2", 0.0) == pytest.approx(0.0, abs=0.01)
    began = [torque_drift.warmer_at_start(1, scene) * per_square for scene in found.bank.scenes]
    assert began == pytest.approx(warm, abs=0.15)
    (note,) = remarks.of_warm_starts(found)
    files, parts = zip(*re.findall(r"(\S+) \((\S+) %\)", note), strict=True)
    assert files == ("1.csv", "3.csv")
    assert [float(part) for part in parts] == pytest.approx([-24, -12], abs=3)
    gains = [{one.joint for one in torque_gain.hypotheses([scene])} for scene in found.bank.scenes]
    assert gains == [{0, 1}] * 3


@dataclass(frozen=True)
class Found:
    """A drift of motor 2 that an earlier search has found, and nothing else."""

    coefficients: dict[str, float]
    warm_up_time: float

    def shape(self, effect: str, joint: int) -> dict[str, float]:
        return {"warm_up_time": self.warm_up_time} if (effect, joint) == ("torque_drift", 2) else {}

    def torque(self, scene: Scene) -> Array:
        return np.zeros_like(scene.motion.q)

    load = torque

    def body(self, scene: Scene) -> Array:
        return np.zeros(10)


def test_a_run_tells_how_warm_it_began_by_samples_in_which_its_joints_move(tmp_path: Path) -> None:
    of = two_links(tmp_path)
    run = ready(logged(tmp_path, 1, Drift(-0.3, 12.0, 1.1, before=5.0), (), 20.0), of)
    found = Found({"torque_drift2": -0.3, "start2": 0.1}, 12.0)
    (known, *_) = torque_drift.hypotheses([scene(run, of)])[-2:]
    nothing, half, all_out = np.zeros((3, *run.sampled.left_out.shape), dtype=bool)
    half[:, : half.shape[1] // 2] = True
    all_out[:] = True
    made = {}
    for name, left_out in (("nothing", nothing), ("half", half), ("all", all_out)):
        tau = np.where(half & (name == "half"), 1e3, run.sampled.tau)
        sampled = replace(run.sampled, left_out=left_out, tau=tau)
        one = replace(scene(run, of), sampled=sampled, beside=found)
        expected = 0.0 if name == "all" else 1 - np.exp(-5 / 12)
        assert torque_drift.warmer_at_start(1, one) == pytest.approx(expected, abs=0.02)
        assert torque_drift.since_cold(1, one) == pytest.approx(0.0 if name == "all" else 5.0, abs=0.4)
        made[name] = known.columns(one, {"warm_up_time": 12.0})[1]
    for name in ("half", "all"):
        at = np.s_[:, made["nothing"].shape[1] // 2 :]
        assert np.linalg.norm((made[name] - made["nothing"])[at]) < 0.12 * np.linalg.norm(made["nothing"][at])


def test_torques_of_a_motor_are_computed_once_for_each_shape(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the column, of the model and of the log."""
    of = two_links(tmp_path)
    found = Found({"torque_drift2": -0.3, "start2": 0.1}, 12.0)
    one = replace(scene(ready(logged(tmp_path, 1, Drift(-0.3, 12.0), (), 20.0), of), of), beside=found)
    (drift, _) = torque_drift.hypotheses([one])[-2:]
    made: list[int] = []

    def counted(robot: Robot, motor: int, tau: Array) -> Array:
        made.append(motor)
        return supplied(robot, motor, tau)

    monkeypatch.setattr(torque_drift, "supplied", counted)
    drift.columns(one, {"warm_up_time": 12.0})
    assert made == [1, 1, 1]


def test_time_constants_are_those_of_all_the_time_since_a_cold_start(tmp_path: Path) -> None:
    """A temperature's rise is that of the recording; no time is so long that a robot file takes it for none."""
    of = two_links(tmp_path)
    path = logged(tmp_path, 1, Drift(-0.1), (), 30.0)
    for since, longest in ((0.0, 150.0), (600.0, 3150.0), (1e9, corrections.NEVER / 2)):
        (tmp_path / "1.yaml").write_text(f"since_cold: {since} s\n")
        one = scene(ready(path, of), of)
        assert one.warmth(1, 20.0)[0] == pytest.approx(1 - np.exp(-(since + one.t[0]) / 20), abs=1e-9)
        times = warm_up_times([one])
        assert (times.low, times.high) == pytest.approx((10.0, longest), rel=0.01)
        assert np.all(np.diff(np.log(times.grid())) < 1)
        assert following([one], [1 - np.exp(-one.t / 30)]) == pytest.approx(30.0, rel=0.2)


def by(kind: str, scenes: Sequence[Scene], joint: int) -> Hypothesis:
    (one,) = [one for one in torque_drift.hypotheses(scenes) if one.joint == joint and f"with the {kind}" in one.title]
    return one


def scene(run: Prepared, regressors: Regressors) -> Scene:
    return Scene(run.sampled, regressors, {name: TRUTH.get(name, 0.0) for name in regressors.names})


def test_a_drift_by_temperature_needs_it_in_every_run(tmp_path: Path) -> None:
    """One that a validating run lacks offers nothing, nor does a warmth that the file cannot tell of it."""
    of, small = two_links(tmp_path), Drift(-0.1)
    runs = [ready(logged(tmp_path, 1, small, (2,), 12.0), of), ready(logged(tmp_path, 2, small, (), 12.0), of)]
    scenes = [scene(run, of) for run in runs]
    assert not [one for one in torque_drift.hypotheses(scenes[:1]) if one.joint == 1 and "temperature" in one.title]
    both = Bank(runs, scenes)
    for kind, there in (("time since the start", True), ("drive's temperature", False)):
        one = by(kind, scenes[:1], 2)
        assert (both.add(one, one.variants[0]) is not None) == there

    path = tmp_path / "told.yaml"
    path.write_text(f"{TWO_LINKS}signals: {{warm_rise: {RISE} K}}\n")
    told = Regressors(read(path))
    runs = [ready(str(tmp_path / name), told) for name in ("1t.csv", "2.csv")]
    scenes = [scene(run, told) for run in runs]
    (friction,) = [one for one in library.hypotheses(scenes[:1]) if one.effect == "warm_friction" and one.joint == 2]
    for one in (by("drive's warmth", scenes[:1], 2), friction):
        assert one.variants == [one.given]
        assert Bank(runs[:1], scenes[:1]).add(one, one.variants[0]) is not None
        assert Bank(runs, scenes).add(one, one.variants[0]) is None


def test_runs_without_a_temperature_are_read_after_a_drift_by_temperature(tmp_path: Path) -> None:
    """They are as warm as the time says, by a constant that follows the temperature; so are drives that have none."""
    of, small = two_links(tmp_path), Drift(-0.1)
    source = logged(tmp_path, 1, small, (2,))
    one = by("drive's temperature", [scene(ready(source, of), of)], 2)
    (shape,) = one.variants
    found = addition(one, shape, {"torque_drift2": -0.1, "start2": 0.0})
    rubbing = Addition(EFFECT, "warm_friction", (1,), {"warm_up_time": 40.0})
    timed = Addition(DRIVE, "torque_drift", (1,), {"torque_drift": 0.05, "torque_gain": 1.0, "warm_up_time": 40.0})
    for additions in ([found, timed], [timed, found], [rubbing, found]):
        robot = repaired(TWO_LINKS, "x", additions).robot
        warm, plain = (load(each, robot) for each in (source, logged(tmp_path, 2, small)))
        measured = small.warmth(warm.elapsed) * RISE / shape["warm_rise"]
        first = 1 - np.exp(-warm.elapsed / 40.0)
        np.testing.assert_allclose(warm.warmth, [first, measured], atol=1e-6)
        np.testing.assert_allclose(plain.warmth, [first, measured], atol=0.04)


@pytest.mark.long
def test_a_testing_run_may_lack_the_temperature(tmp_path: Path) -> None:
    of, drift = two_links(tmp_path), Drift(-0.2, time=0.0)
    runs = [ready(logged(tmp_path, seed, drift, (2,)), of) for seed in (1, 2)]
    found = search(runs, (0,), (1,), of)
    kept, gone = confirmed(found, along(found, [ready(logged(tmp_path, 3, drift), of)]))
    assert not gone
    ((drift_found, *_),) = [one.evidence.coefficients for one in kept.choices]
    assert "warm_rise" in kept.choices[0].evidence.variant.shape
    assert drift_found == pytest.approx(drift.drift, rel=0.01)


def test_heat_that_the_file_tells_is_of_the_record(tmp_path: Path) -> None:
    """That of joint 2: the file has the other by time alone."""
    path = tmp_path / "told.yaml"
    path.write_text(f"{TWO_LINKS}signals: {{warm_up_time: 20 s, warm_torque: [1000000 N m, 0.5 N m]}}\n")
    of = Regressors(read(path))
    scenes = [scene(ready(logged(tmp_path, 1, Drift(-0.1), (), 30.0), of), of)]
    for joint, of_record in ((1, False), (2, True)):
        assert by("drive's warmth", scenes, joint).recorded == of_record
        both = [one for one in library.hypotheses(scenes) if one.joint == joint]
        assert {one.effect: one.recorded for one in both}["warm_friction"] == of_record
        assert not {one.effect: one.recorded for one in both}["power_friction"]


def test_a_drift_by_which_a_run_has_no_torque_constant_is_told_and_not_written(tmp_path: Path) -> None:
    sources = [logged(tmp_path, seed, Drift(-0.1), (), 20.0) for seed in (1, 2)]
    roles = Roles(tuple(sources[:1]), (), tuple(sources[1:]), tuple(sources[:1]))
    values = {"torque_drift": -0.5, "torque_gain": 1.0, "warm_up_time": 5.0}
    first, second = (
        Addition(DRIVE, "torque_drift", (joint,), {**values, "warm_torque": usual})
        for joint, usual in ((1, 1e3), (2, 0.1))
    )
    kept, said = writable(TWO_LINKS, "x", [first, second], roles, [])
    assert kept == [first]
    (note,) = said
    assert "torque constant of joint 2 is not written" in note
    assert "warmth of " in note
    assert writable(TWO_LINKS, "x", [first], roles, []) == ([first], [])


def test_heat_that_is_of_the_record_tells_nothing_of_its_noise(tmp_path: Path) -> None:
    of = two_links(tmp_path)
    run = ready(logged(tmp_path, 1, Drift(-0.1), (), 12.0), of)
    scenes = [scene(run, of)]
    bank = Bank([run], scenes)
    heat, time = (by(kind, scenes, 2) for kind in ("motor's heat", "time since the start"))
    columns = []
    for one in (heat, time):
        made = bank.add(one, one.variants[0])
        assert made is not None
        columns.append(set(made.columns))
    numbers = set(without_record(bank, 0, 1).numbers)
    assert not numbers & columns[0]
    assert numbers >= columns[1]
