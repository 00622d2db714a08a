"""Candidates about drives beside what the runs hold and the robot's file says of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy

from generator.robot.readers import read
from identification.corrections import recorded_motor_torques
from identification.dataset import load
from identification.diagnosis.candidates import current_limit, gear_ratio
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.diagnosis import NAMED
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import coupling, motor_torques
from identification.filtering import flat_derivative
from identification.observation import Regressors
from identification.recipes import Recipe
from identification.residuals import rms
from identification.sampling import sampled
from tests.diagnosis.diagnosed import Found, known, played, with_robot
from tests.diagnosis.diagnosed_arm import diagnosis_of
from tests.plant.effect import Effect
from tests.plant.robots import ROBOTS
from tests.plant.trajectories.fourier import fourier
from tests.recorded import TRUTH, TWO_LINKS, Recorded
from tests.recorded import fourier as trajectory

JOINT = 2


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Scene:
    """A run in which the motor of a joint clips its current."""
    arm = known(ROBOTS["kr500_like"], tmp_path_factory.mktemp("robot"))
    found, _, _ = played(arm, Effect("current_saturation", JOINT), fourier(1, period=10.0, periods=1, before=2.0))
    return found


def test_a_ratio_is_offered_where_the_file_has_a_say_in_it(scene: Scene) -> None:
    """What was recorded on the joint side stays what it is."""
    of_joints = replace(scene, sampled=replace(scene.sampled, run=replace(scene.sampled.run, by_motors=False)))
    assert len(gear_ratio.hypotheses([scene])) == 6
    assert gear_ratio.hypotheses([of_joints]) == []
    assert gear_ratio.hypotheses([scene, of_joints]) == []


def limit(one: Scene) -> Hypothesis:
    (found,) = [each for each in current_limit.hypotheses([one]) if each.joint == JOINT]
    return found


def test_a_limit_is_one_of_the_recorded_current(scene: Scene) -> None:
    """Where the file states a gain, torques are no longer what was recorded."""
    gains = tuple(sympy.Rational(9, 10) if j == JOINT else sympy.Integer(1) for j in range(1, 7))
    signals = replace(scene.robot.signals, torque_gain=gains)
    stated = with_robot(scene, replace(scene.robot, signals=signals))
    plain, gained = limit(scene).shapes[0], limit(stated).shapes[0]
    assert (gained.low, gained.high) == pytest.approx((plain.low / 0.9, plain.high / 0.9))
    columns = limit(stated).columns(stated, {"current_limit": gained.low})
    assert columns == pytest.approx(limit(scene).columns(scene, {"current_limit": plain.low}))


def test_a_limit_is_one_of_the_recorded_current_of_a_warm_motor(scene: Scene) -> None:
    """Of one whose torque constant drifts by the file: what is clipped is what was recorded all the same."""
    assert scene.robot.drives is not None
    drift = tuple(sympy.Rational(-3, 10) if j == JOINT else sympy.Integer(0) for j in range(1, 7))
    motion = replace(scene.motion, warmth=np.linspace(0, 1, scene.motion.samples) * np.ones((6, 1)))
    factor = np.ones_like(motion.q)
    factor[JOINT - 1] -= 0.3 * motion.warmth[JOINT - 1]
    tau = coupling(scene.robot).T @ (factor * motor_torques(scene.robot, scene.tau))
    warm = replace(scene, sampled=replace(scene.sampled, motion=motion, tau=tau))
    warm = with_robot(warm, replace(scene.robot, drives=replace(scene.robot.drives, torque_drift=drift)))
    plain, warmed = limit(scene).shapes[0], limit(warm).shapes[0]
    assert (warmed.low, warmed.high) == pytest.approx((plain.low, plain.high))


def test_a_ratio_scales_what_the_encoder_told_and_not_the_files_offset(tmp_path: Path) -> None:
    """What a wrong ratio misses on the other joint is what the right one makes of the same log."""
    text, error = TWO_LINKS + "signals: {position_offset: [0 rad, 1.5 rad]}\n", 0.05
    (tmp_path / "wrong.yaml").write_text(text)
    (tmp_path / "right.yaml").write_text(text.replace("-80", f"{-80 * (1 + error)}"))
    t, motion = trajectory(read(tmp_path / "wrong.yaml"), 6.0, 200.0, 1)
    motors = {f"qm{j}": q for j, q in enumerate(coupling(read(tmp_path / "wrong.yaml")) @ motion.q, 1)}
    source = Recorded({"t": t, **motors, "taum1": np.sin(t), "taum2": np.cos(t)}).save(tmp_path / "run.csv")

    def seen(name: str) -> Scene:
        robot = read(tmp_path / name)
        recipe = Recipe().changed(cutoff=40.0, factor=1, standstill=0.0)
        run = sampled(load(str(source), robot, {}), recipe, Regressors(robot), flat_derivative)
        return Scene(run, Regressors(robot), TRUTH, Found({"gear_ratio_error2": error}))

    wrong, right = seen("wrong.yaml"), seen("right.yaml")
    (found,) = (each for each in gear_ratio.hypotheses([wrong]) if each.joint == JOINT)
    missed = (right.torque - wrong.torque)[0]
    assert rms(missed) > 0.1
    np.testing.assert_allclose(error * found.columns(wrong, {})[0, 0], missed, atol=1e-6 * rms(missed))


@pytest.mark.parametrize("late", [1, 2])
@pytest.mark.long
def test_a_motor_that_is_late_acts_on_all_joints_that_it_drives(late: int, tmp_path: Path) -> None:
    """The file's delay is of the motor, of which a coupled drive shows a part on another joint."""
    text = TWO_LINKS.replace("N21: 5", "N21: 60")
    (tmp_path / "two_links.yaml").write_text(text)
    delays = ", ".join("6 ms" if number == late else "0 ms" for number in (1, 2))
    (tmp_path / "late.yaml").write_text(f"{text}signals: {{torque_delay: [{delays}]}}\n")
    robot, true, draw = read(tmp_path / "two_links.yaml"), read(tmp_path / "late.yaml"), np.random.default_rng(1)
    regressors, sources = Regressors(robot), []
    for number in range(3):
        t, motion = trajectory(robot, 40.0, 250.0, number)
        motors = np.linalg.solve(coupling(robot).T, regressors.torques(TRUTH, motion))
        motors = recorded_motor_torques(motors, true, 1 / 250, None) + 0.002 * draw.normal(size=motors.shape)
        q = coupling(robot) @ motion.q
        columns = {"t": t, "qm1": q[0], "qm2": q[1], "taum1": motors[0], "taum2": motors[1]}
        sources.append(str(Recorded(columns).save(tmp_path / f"{number}.csv")))
    found = diagnosis_of(sources, regressors)
    assert found.verdict == NAMED
    (one,) = found.findings
    assert one.hypothesis.key == ("torque_delay", late)
    assert one.parameters[f"torque_delay{late}"].value == pytest.approx(0.006, rel=0.1)
