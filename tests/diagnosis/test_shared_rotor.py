"""A rotor that two joints turn may stand while both of them move: its friction is any then, and tells nothing."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.diagnosis.candidates import wrist
from identification.diagnosis.diagnosis import NAMED
from identification.diagnosis.runs.scene import Scene
from identification.observation import Motion, Regressors
from identification.outcome import Value
from tests.diagnosis.diagnosed_arm import diagnosis_of, ready
from tests.recorded import Array, Recorded, as_recorded

#: Two links in a horizontal plane.
PLANAR = """\
name: planar
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 0, alpha: 0, d: 0.5 m, theta: q2, r: 0}
effects:
  - {effect: viscous_friction, joints: [1, 2]}
  - {effect: coulomb_friction, joints: [1, 2]}
"""
TRUTH = {"ZZ1R": 4.0, "ZZ2": 1.2, "MX2": 1.5, "MY2": 0.1, "Fv1": 6.0, "Fc1": 3.0, "Fv2": 2.0, "Fc2": 1.5}
FRICTION, VISCOUS, REACH = 1.2, 0.8, 2e-5
#: Time [s] after which a motion repeats, samples, their distance [s], and the noise of the torques [N m].
PERIOD, COUNT, STEP, NOISE = 10.0, 10000, 0.004, 0.05


def _of_time(draw: np.random.Generator) -> tuple[Array, Motion]:
    """Joint 1 on a Fourier series; joint 2 against it, but for a rotor that pauses again and again."""
    t, w = STEP * np.arange(COUNT), 2 * np.pi / PERIOD
    q = np.zeros((3, 2, COUNT))
    for k in range(1, 5):
        a, phase = draw.uniform(0.2, 0.5) / k, draw.uniform(0, 2 * np.pi)
        for order in range(3):
            q[order, 0] += a * (k * w) ** order * np.cos(k * w * t + phase + order * np.pi / 2)
    pause = w * t + draw.uniform(0, 2 * np.pi)
    speed = draw.uniform(1.0, 2.0)
    turned = speed * STEP * np.cumsum(np.sin(pause) ** 5)
    rotor = np.array([turned - turned.mean(), speed * np.sin(pause) ** 5, 5 * w * speed * np.sin(pause) ** 4])
    rotor[2] *= np.cos(pause)
    q[:, 1] = rotor - q[:, 0]
    return t, Motion(*q)


def _dry(s: Array) -> Array:
    """What friction by Dahl makes along the way ``s`` [rad]."""
    result = np.zeros_like(s)
    for i, step in enumerate(np.diff(s)):
        result[i + 1] = np.sign(step) + (result[i] - np.sign(step)) * np.exp(-abs(step) / REACH)
    return result


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.long)])
def test_a_rotor_that_stands_while_its_joints_move(seed: int, tmp_path: Path) -> None:
    (tmp_path / "planar.yaml").write_text(PLANAR)
    robot = read(tmp_path / "planar.yaml")
    regressors, draw, sources = Regressors(robot), np.random.default_rng(seed), []
    for number in range(3):
        t, motion = _of_time(draw)
        shared = FRICTION * _dry(motion.q.sum(axis=0)) + VISCOUS * motion.qd.sum(axis=0)
        tau = regressors.torques(TRUTH, motion) + shared + NOISE * draw.normal(size=motion.q.shape)
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(tmp_path / f"{number}.csv")))
    found = diagnosis_of(sources, regressors)
    assert found.verdict == NAMED
    (one,) = found.findings
    assert (one.hypothesis.effect, one.hypothesis.joints) == ("coupled_rotor", (1, 2))
    assert one.parameters["Fcr2"].value == pytest.approx(FRICTION, rel=0.05)
    assert one.parameters["Fvr2"].value == pytest.approx(VISCOUS, rel=0.05)
    assert one.variable == "qd"
    zero, some = Value(0.0, 0.0, ""), Value(1.0, 0.1, "kg m2")
    inertia = replace(one, parameters={"Iar2": some, "Fvr2": zero, "Fcr2": zero})
    assert inertia.variable == "qdd"


@pytest.mark.parametrize("fixed", [0, 2])
def test_a_pair_is_offered_across_fixed_frames_and_not_across_branches(fixed: int, tmp_path: Path) -> None:
    base, last = 1 + fixed, 2 + fixed
    frames = [f"{{j: {j}, sigma: 2, alpha: 0, d: 0.1 m, theta: 0, r: 0}}" for j in range(2, last)]
    joints = [
        "{j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}",
        *frames,
        f"{{j: {last}, antecedent: {base}, sigma: 0, alpha: 0, d: 0.5 m, theta: q{last}, r: 0}}",
        f"{{j: {last + 1}, antecedent: {base}, sigma: 0, alpha: pi/2, d: 0.2 m, theta: q{last + 1}, r: 0}}",
    ]
    lines = "".join(f"  - {joint}\n" for joint in joints)
    (tmp_path / "branched.yaml").write_text(f"name: branched\ngravity: [0 m/s2, 0 m/s2, 0 m/s2]\njoints:\n{lines}")
    regressors = Regressors(read(tmp_path / "branched.yaml"))
    t, motion = _of_time(np.random.default_rng(1))
    q = [*motion.q, motion.q[1]]
    columns = {f"q{j}": x for j, x in zip((1, last, last + 1), q, strict=True)}
    columns |= {f"tau{j}": np.cos(t) for j in (1, last, last + 1)}
    run = ready(str(Recorded({"t": t, **columns}).save(tmp_path / "a.csv")), regressors)
    found = wrist.hypotheses([Scene(run.sampled, regressors, {})])
    assert {one.joints for one in found} == {(1, last)}


@pytest.mark.parametrize(("slide", "offered"), [(0.01, True), (0.5, False)])
def test_what_a_turn_and_a_slide_share_is_weighed_by_their_speeds(slide: float, offered: bool, tmp_path: Path) -> None:
    """A screw of 0.05 m a turn: a slow slide turns its nut no faster than the joint beside it does."""
    sliding = "{j: 2, sigma: 1, alpha: 0, d: 0, theta: 0, r: q2}"
    text = PLANAR.replace("{j: 2, sigma: 0, alpha: 0, d: 0.5 m, theta: q2, r: 0}", sliding)
    drives = "drives:\n  gear_ratios: [1, 125.66]\n  coupling: {convention: direct, N21: 1}\n"
    (tmp_path / "quill.yaml").write_text(text + drives)
    regressors = Regressors(read(tmp_path / "quill.yaml"))
    t, motion = _of_time(np.random.default_rng(1))
    columns = {"t": t, "q1": motion.q[0], "q2": slide * motion.q[1], "tau1": np.cos(t), "tau2": np.cos(t)}
    run = ready(str(Recorded(columns).save(tmp_path / "a.csv")), regressors)
    found = wrist.hypotheses([Scene(run.sampled, regressors, {})])
    assert [one.given["ratio"] for one in found] == ([pytest.approx(1 / 125.66)] if offered else [])
