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


def hysteresis(q: Array, qd: Array, reach: float = REACH, first: float = 0.0) -> Array:
    """By Bouc and Wen, from no deflection at the beginning or the ``first`` part of the largest, in small steps of the
    way.
    """
    count = len(q)
    way = np.diff(np.interp(np.arange((count - 1) * FINE + 1) / FINE, np.arange(count), q))
    z = np.zeros(len(way) + 1)
    z[0] = first
    for i, step in enumerate(way.tolist()):
        bent = abs(z[i]) ** SHARPNESS
        z[i + 1] = z[i] + (step - bent * (step + abs(step) * np.sign(z[i])) / 2) / reach
    return np.asarray(LARGEST * z[::FINE])


def test_a_hysteresis_of_another_bend_that_begins_undeflected(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [hysteresis] * 3)
    (one,) = diagnosis_of(sources, regressors).findings
    assert one.hypothesis.effect == "hysteresis"
    assert one.parameters["Fh1"].value == pytest.approx(LARGEST, rel=0.05)
    assert one.shape["xs"] == pytest.approx(REACH, rel=0.05)
    assert one.shape["exponent"] == pytest.approx(SHARPNESS, abs=3 * one.shape_std["exponent"])


def test_a_hysteresis_that_begins_deflected_the_other_way_is_no_event(tmp_path: Path) -> None:
    """A second of motion does not wear in what reaches far."""

    def against(q: Array, qd: Array) -> Array:
        return 2 * hysteresis(q, qd, 3 * REACH, -float(np.sign(np.mean(qd[:10]))))

    regressors, sources = recorded(tmp_path, [against] * 3)
    found = diagnosis_of(sources, regressors)
    assert [one.hypothesis.effect for one in found.findings] == ["hysteresis"]
    assert found.verdict == "effects_named"
    assert [one.event for one in found.after.lack] == [""]


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


def test_what_no_record_tells_of_a_bristle_fades_with_the_way(tmp_path: Path) -> None:
    """By Dahl z' = (qd - |qd| z)/reach: two states a way apart differ by exp(-way/reach) of what they did at first."""
    reach = 0.3
    regressors, (source,) = recorded(tmp_path, [lambda q, qd: 0.0 * q])
    run = ready(source, regressors)
    scene = Scene(run.sampled, regressors, TRUTH)
    (joint,) = regressors.model.robot.moving
    columns = EffectColumns(library()["dahl_friction"], joint, 0, regressors.model.robot)
    shape = {one.name: reach for one in library()["dahl_friction"].shapes}
    begun = columns.of_beginning(scene, shape)[0, 0]
    speed = np.abs(scene.motion.qd[0])
    way = np.concatenate([[0.0], np.cumsum((speed[1:] + speed[:-1]) / 2) * scene.period])
    first = begun[0]
    assert 0.0 < first <= 2.0
    np.testing.assert_allclose(begun / first, np.exp(-way / reach), atol=0.01)
