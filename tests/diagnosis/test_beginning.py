"""What a log cannot tell, how bristles were deflected before it began, and how they are deflected along the way."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.effects.library import library
from generator.robot.readers import read
from identification.diagnosis.columns.effect_columns import EffectColumns
from identification.diagnosis.runs.scene import Scene
from identification.observation import Regressors
from tests.diagnosis.diagnosed_arm import ARM, TRUTH, diagnosis_of, ready, recorded
from tests.recorded import Array, Recorded, fourier

#: Largest torque [N m] and first deflection [rad] of a hysteresis, and the sharpness of its bend.
LARGEST, REACH, SHARPNESS = 4.0, 0.05, 1.0
#: Steps between two samples in which its state follows the motion.
FINE = 40


def hysteresis(q: Array, qd: Array) -> Array:
    """By Bouc and Wen, from no deflection at the beginning, in small steps of the way."""
    count = len(q)
    way = np.diff(np.interp(np.arange((count - 1) * FINE + 1) / FINE, np.arange(count), q))
    z = np.zeros(len(way) + 1)
    for i, step in enumerate(way.tolist()):
        bent = abs(z[i]) ** SHARPNESS
        z[i + 1] = z[i] + (step - bent * (step + abs(step) * np.sign(z[i])) / 2) / REACH
    return np.asarray(LARGEST * z[::FINE])


def test_a_hysteresis_of_another_bend_that_begins_undeflected(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [hysteresis] * 3)
    (one,) = diagnosis_of(sources, regressors).findings
    assert one.hypothesis.effect == "hysteresis"
    assert one.parameters["Fh1"].value == pytest.approx(LARGEST, rel=0.05)
    assert one.shape["xs"] == pytest.approx(REACH, rel=0.05)
    assert one.shape["exponent"] == pytest.approx(SHARPNESS, abs=3 * one.shape_std["exponent"])


@pytest.mark.parametrize(("duration", "first"), [(30.0, 1.0), (10.0, 0.0)])
def test_the_first_second_of_a_long_run_is_left_out(duration: float, first: float, tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(ARM)
    regressors = Regressors(read(tmp_path / "arm.yaml"))
    t, motion = fourier(regressors.model.robot, duration, 100.0, 1)
    tau = regressors.torques(TRUTH, motion)[0]
    run = ready(str(Recorded({"t": t, "q1": motion.q[0], "tau1": tau}).save(tmp_path / "a.csv")), regressors)
    assert run.t[run.kept[0]][0] == pytest.approx(max(first, run.t[0]), abs=0.1)
    assert not run.kept[0, run.t < first].any()


def test_bristles_follow_the_way_between_the_samples(tmp_path: Path) -> None:
    """By Dahl, exact along the way: z moves to the direction as the way grows by its reach."""
    reach = 0.004
    regressors, (source,) = recorded(tmp_path, [lambda q, qd: 0.0 * q])
    run = ready(source, regressors)
    scene = Scene(run.sampled, regressors, TRUTH)
    found = EffectColumns(library()["dahl_friction"], regressors.model.robot.moving[0], 0, regressors.model.robot)
    column = found(scene, {"xs": reach})[0, 0]
    t, motion = fourier(regressors.model.robot, 40.0, 100.0, 1)
    fine = np.linspace(t[0], t[-1], FINE * (len(t) - 1) + 1)
    z, way = np.zeros(len(fine)), np.diff(np.interp(fine, t, motion.q[0]))
    for i, step in enumerate(way.tolist()):
        z[i + 1] = np.sign(step) + (z[i] - np.sign(step)) * np.exp(-abs(step) / reach)
    exact = np.interp(scene.sampled.times, fine, z)[200:]
    assert np.sqrt(np.mean((column[200:] - exact) ** 2)) < 0.02
