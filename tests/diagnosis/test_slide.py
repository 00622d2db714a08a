"""One slide on level ground: what its mass scales and what is the same all along tell of no gain and no tilt."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy
from scipy.integrate import cumulative_trapezoid
from scipy.signal import lfilter

from generator.robot.description import EffectUse, ParameterSet, ParameterValue
from generator.units import Quantity
from identification.diagnosis.candidates import backlash, base_tilt, elasticity
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NAMED, NOTHING, Diagnosis
from identification.diagnosis.verdict.finding import FIRM
from identification.observation import Motion
from tests.diagnosis.diagnosed import with_robot
from tests.diagnosis.diagnosed_arm import answered
from tests.recorded import SLIDE, Array, Recorded

MASS, VISCOUS, DRY, OFFSET = 95.0, 200.0, 20.0, -3.0
#: Samples a second, and seconds of a run.
RATE, SECONDS = 1000.0, 25.0
#: Time [s] by which the force is late, and speed [m/s] over which dry friction rises.
LATE, RISE = 0.0008, 0.015

#: A dry friction [N] over the speed [m/s].
Dry = Callable[[Array], Array]


def to_and_fro(seed: int) -> tuple[Array, Motion]:
    """Moves of trapezoidal speed, each with another top speed and another acceleration."""
    draw = np.random.default_rng(seed)
    speed = [np.zeros(200)]
    way = 1.0
    while sum(map(len, speed)) < RATE * SECONDS:
        top, rise = draw.uniform(0.015, 0.1), draw.uniform(0.15, 0.8)
        ramp = np.arange(0.0, top, rise / RATE)
        speed.append(way * np.concatenate([ramp, np.full(int(0.6 * RATE), top), ramp[::-1], np.zeros(100)]))
        way = -way
    qd = np.convolve(np.concatenate(speed), np.hanning(80) / np.hanning(80).sum(), "same")[: int(RATE * SECONDS)]
    q = cumulative_trapezoid(qd, dx=1 / RATE, initial=0.0)
    t = np.arange(len(q)) / RATE
    return t, Motion(q[None], qd[None], np.gradient(qd, 1 / RATE)[None])


def swaying(seed: int) -> tuple[Array, Motion]:
    """Some millimetres of slow motion, which repeats after four seconds."""
    draw = np.random.default_rng(seed)
    t = np.arange(int(RATE * SECONDS)) / RATE
    speeds = 2 * np.pi * np.array([[0.25], [0.5], [0.75]])
    sizes, phases = draw.uniform(0.003, 0.008, (3, 1)), draw.uniform(0, 2 * np.pi, (3, 1))
    waves = sizes * np.exp(1j * (speeds * t + phases))
    q, qd, qdd = (np.sum((1j * speeds) ** k * waves, axis=0).imag[None] for k in range(3))
    return t, Motion(q, qd, qdd)


def diagnosis(folder: Path, dry: Dry, late: float, of: Callable[[int], tuple[Array, Motion]] = to_and_fro) -> Diagnosis:
    """Of two runs, of which the end tests."""
    path = folder / "slide.yaml"
    path.write_text(SLIDE)
    draw, sources = np.random.default_rng(5), []
    for seed in (1, 2):
        t, motion = of(seed)
        force = MASS * motion.qdd[0] + VISCOUS * motion.qd[0] + dry(motion.qd[0]) + OFFSET
        tau = np.interp(t - late, t, force) + lfilter([1], [1, -0.6], 0.8 * draw.normal(size=len(t)))
        q = np.round(motion.q[0] / 1e-7) * 1e-7
        sources.append(str(Recorded({"t": t, "q1": q, "tau1": tau}).save(folder / f"{seed}.csv")))
    return answered(path, Request(sources), folder / "out")[0]


@pytest.mark.long
def test_a_force_that_is_late_and_friction_that_rises_are_told_together(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, lambda qd: DRY * np.tanh(qd / RISE), LATE)
    assert found.verdict == NAMED
    named = {one.hypothesis.effect: one for one in found.findings}
    assert set(named) == {"gradual_friction", "torque_delay"}
    assert {one.status for one in found.findings} == {FIRM}
    assert "torque_gain" in {one.effect for one in found.invisible}
    assert named["torque_delay"].parameters["torque_delay"].value == pytest.approx(LATE, abs=2e-4)
    assert named["gradual_friction"].parameters["Fg1"].value == pytest.approx(DRY, rel=0.2)


def bristles(xs: float) -> Dry:
    """Dahl's friction, each sample solved exactly for a constant speed; it builds up within ``xs`` [m]."""

    def of(qd: Array) -> Array:
        z, result = 0.0, np.empty_like(qd)
        for i, v in enumerate(qd.tolist()):
            left = math.exp(-abs(v) / (xs * RATE))
            z = left * z + (1 - left) * math.copysign(1.0, v)
            result[i] = DRY * z
        return result

    return of


@pytest.mark.long
def test_short_ways_show_presliding_over_shorter_ones(tmp_path: Path) -> None:
    xs = 1e-4
    found = diagnosis(tmp_path, bristles(xs), 0.0, swaying)
    (one,) = found.findings
    assert found.verdict == NAMED
    assert "dahl_friction" in {one.hypothesis.effect, *(other.effect for other in one.alternatives)}
    assert one.shape["xs"] == pytest.approx(xs, abs=3 * one.shape_std["xs"])
    assert one.shape_std["xs"] < xs / 5


@pytest.fixture(scope="module")
def right(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """Of a model that lacks nothing."""
    return diagnosis(tmp_path_factory.mktemp("right"), lambda qd: DRY * np.sign(qd), 0.0)


def test_nothing_is_named_where_nothing_is_missing(right: Diagnosis) -> None:
    assert (right.verdict, right.findings) == (NOTHING, ())
    assert "torque_gain" in {one.effect for one in right.invisible}
    assert base_tilt.hypotheses(right.search.bank.scenes) == []


@pytest.fixture(scope="module")
def drive_train(right: Diagnosis) -> tuple[Hypothesis, Hypothesis]:
    """An elastic one and one with a gap, which the robot's runs may hide."""
    scenes = right.search.bank.scenes
    (soft,), (loose,) = elasticity.hypotheses(scenes), backlash.hypotheses(scenes)
    return soft, loose


def test_no_drive_train_is_looked_for_where_an_encoder_or_the_file_tells(
    drive_train: tuple[Hypothesis, Hypothesis], right: Diagnosis
) -> None:
    assert [one.effect for one in drive_train] == ["joint_elasticity", "backlash"]
    (scene, *_) = right.search.bank.scenes
    run = replace(scene.sampled.run, others={"qs1": scene.t})
    watched = replace(scene, sampled=replace(scene.sampled, run=run))
    gap = EffectUse("joint_elasticity", (1,), {"gap": Quantity(sympy.Rational(1, 1000), "m")})
    sets = {"stiff": ParameterSet("stiff", "", "", {"k1": ParameterValue(1e6, "N/m")})}
    effects = (*scene.robot.effects, gap)
    elastic = with_robot(scene, replace(scene.robot, flexible=(1,), effects=effects, parameter_sets=sets))
    for one in (watched, elastic):
        assert elasticity.hypotheses([one]) == []
        assert backlash.hypotheses([one]) == []


@pytest.mark.parametrize(("part", "alike"), [(1.0, True), (0.2, True), (0.05, False), (20.0, False)])
def test_size_and_time_tell_one_drive_train(
    part: float, alike: bool, drive_train: tuple[Hypothesis, Hypothesis]
) -> None:
    """The file knows no rotor, so that they may differ by a factor of ten and no more."""
    soft, loose = drive_train
    assert soft.agrees is not None
    assert soft.agrees(np.array([part / 1e4]), {"k": 1e4}) == alike
    assert loose.agrees is not None
    assert loose.agrees(np.array([part * 1e-3]), {"gap": 1e-3}) == alike
