"""Corrections that the robot's file states wrongly: what is found is beyond them, and the repaired file is right."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.diagnosis.columns.hypothesis import BEYOND, SIGNAL
from identification.diagnosis.diagnosis import NAMED, NOTHING, Diagnosis
from identification.diagnosis.mending.addition import Addition, addition
from identification.diagnosis.mending.repair import repaired
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE
from identification.drive_train import coupling
from identification.observation import Regressors
from tests.diagnosis.diagnosed_arm import diagnosis_of
from tests.recorded import TRUTH, TWO_LINKS, as_recorded, fourier, parameters_text

#: The true position of joint 1 beyond the recorded one [rad]; of motor 2 true torque over the recorded one when it is
#: cold, how much more it is when it is warm, and by what time that is [s].
OFFSET, GAIN, DRIFT, TIME = 0.05, 0.9, -0.2, 15.0
RIGHT = {"position_offset": OFFSET, "torque_gain": GAIN, "torque_drift": DRIFT}


def wrong_logs(folder: Path) -> list[str]:
    """Files of three runs, whose log is as wrong as that."""
    path = folder / "true.yaml"
    path.write_text(TWO_LINKS)
    regressors, draw, sources = Regressors(read(path)), np.random.default_rng(2), []
    N = coupling(regressors.model.robot)
    for seed in range(1, 4):
        t, motion = fourier(regressors.model.robot, 20.0, 200.0, seed)
        motor = np.linalg.solve(N.T, regressors.torques(TRUTH, motion) + draw.normal(size=motion.q.shape))
        motor[1] /= GAIN * (1 + DRIFT * (1 - np.exp(-t / TIME)))
        tau = N.T @ motor
        logged = motion.q - np.array([[OFFSET], [0.0]])
        sources.append(str(as_recorded(regressors, t, logged, tau).save(folder / f"{seed}.csv")))
    return sources


def stating(position_offset: float, torque_gain: float, torque_drift: float) -> str:
    text = TWO_LINKS.replace("drives:\n", f"drives:\n  torque_drift: [0, {torque_drift}]\n")
    signals = (
        f"position_offset: [{position_offset} rad, 0 rad], torque_gain: [1, {torque_gain}], warm_up_time: {TIME} s"
    )
    return f"{text}signals: {{{signals}}}\n{parameters_text({'known': TRUTH})}"


def diagnosed(folder: Path, text: str) -> Diagnosis:
    path = folder / "two_links.yaml"
    path.write_text(text)
    return diagnosis_of(wrong_logs(folder), Regressors(read(path)), "known")


@pytest.mark.parametrize(
    ("wrong", "stated"), [("torque_gain", 0.7), pytest.param("torque_drift", 0.1, marks=pytest.mark.long)]
)
def test_another_value_than_the_stated_one_is_found(wrong: str, stated: float, tmp_path: Path) -> None:
    text = stating(**(RIGHT | {wrong: stated}))
    found = diagnosed(tmp_path, text)
    assert found.verdict == NAMED
    (one,) = found.findings
    assert (one.hypothesis.key, one.status) == ((wrong, 2), FIRM)
    assert one.hypothesis.title.endswith(BEYOND)
    values = {name: value.value for name, value in one.parameters.items() if value.value is not None}
    robot = repaired(text, "x", [addition(one.hypothesis, one.shape, values)]).robot
    assert robot.drives is not None
    written = [float(of[1]) for of in (robot.signals.torque_gain, robot.drives.torque_drift)]
    assert written == pytest.approx([GAIN, DRIFT], rel=0.02)


@pytest.mark.long
def test_another_offset_than_the_stated_one_is_one_of_what_may_be(tmp_path: Path) -> None:
    """Of a horizontal axis that stands on the base, which may be tilted as well."""
    (one,) = diagnosed(tmp_path, stating(**(RIGHT | {"position_offset": 0.1}))).findings
    assert one.status == TENTATIVE
    assert {one.hypothesis.effect, *(each.effect for each in one.alternatives)} == {"base_tilt", "position_offset"}
    angle = one.parameters["tilt_y" if one.hypothesis.effect == "base_tilt" else "position_offset1"]
    assert angle.value is not None
    assert abs(angle.value) == pytest.approx(0.1 - OFFSET, abs=3 * angle.std)


def test_an_offset_beyond_the_stated_one_adds_to_it() -> None:
    text = stating(**(RIGHT | {"position_offset": 0.1}))
    found = Addition(SIGNAL, "position_offset", (1,), values={"position_offset": OFFSET - 0.1})
    written = repaired(text, "x", [found]).robot.signals.position_offset
    assert [float(x) for x in written] == pytest.approx([OFFSET, 0.0])


def test_what_is_stated_rightly_is_not_found_again(tmp_path: Path) -> None:
    assert diagnosed(tmp_path, stating(**RIGHT)).verdict == NOTHING
