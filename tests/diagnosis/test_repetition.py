"""Runs that hardly repeat, that repeat beside others that do not, and with fewer rows than the model needs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.diagnosis.diagnosis import NOTHING, UNEXPLAINED, Diagnosis
from identification.diagnosis.noise.measured import _common
from identification.diagnosis.runs.phases import between_periods
from identification.observation import Motion, Regressors
from tests.diagnosis.diagnosed_arm import ARM, TRUTH, diagnosis_of
from tests.recorded import Array, Recorded, fourier

RATE = 250.0


def diagnosis(
    folder: Path, periods: Sequence[float], seconds: float, hidden: float, noise: float, part: float = 1.0
) -> Diagnosis:
    """Of runs that repeat after so many seconds, on a part of the way if they come twice, with friction about a place
    (0.3 rad) that no law tells.
    """
    (folder / "arm.yaml").write_text(ARM)
    robot = read(folder / "arm.yaml")
    regressors, draw, sources = Regressors(robot), np.random.default_rng(3), []
    for seed, period in enumerate(periods, 1):
        t, m = fourier(robot, seconds, RATE, seed, 1 / period)
        if part < 1 and 2 * period <= seconds:
            m = Motion(part * m.q - 0.9, part * m.qd, part * m.qdd)
        tau = regressors.torques(TRUTH, m)[0] + noise * draw.normal(size=len(t))
        tau += hidden * np.exp(-(((m.q[0] - 0.3) / 0.06) ** 2)) * np.sign(m.qd[0])
        sources.append(str(Recorded({"t": t, "q1": m.q[0], "tau1": tau}).save(folder / f"{seed}.csv")))
    return diagnosis_of(sources, regressors)


def test_two_periods_are_compared_though_their_ends_are_lost(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, [8.0, 8.0], 16.0, 0.9, 0.3)
    assert [run.period for run in found.runs] == [400, 400]
    assert all(1.9 < run.times < 2 for run in found.runs)
    assert (found.verdict, found.after.lack[0].repeats) == (UNEXPLAINED, True)


def test_a_run_that_repeats_does_not_blind_the_others(tmp_path: Path) -> None:
    """Only the others pass the place."""
    found = diagnosis(tmp_path, [5.0, 33.0], 30.0, 1.5, 0.3, 0.25)
    assert [bool(run.period) for run in found.runs] == [True, False]
    assert found.verdict == UNEXPLAINED
    assert not found.after.lack[0].repeats


@pytest.mark.parametrize("period", [8.0, 33.0])
def test_runs_without_noise_lack_nothing(period: float, tmp_path: Path) -> None:
    found = diagnosis(tmp_path, [period, period], 20.0, 0.0, 0.0)
    assert found.verdict == NOTHING
    assert not found.findings


@pytest.mark.parametrize("periods", [1.9, 2.6, 3.0])
def test_noise_between_periods_keeps_its_freedom(periods: float) -> None:
    """Squares over what is not common are the power of white noise, wherever the last period ends."""
    draw, period = np.random.default_rng(2), 200
    kept = np.arange(round(periods * period)) % 7 != 3
    every: list[Array] = []
    for _ in range(300):
        e = between_periods(draw.normal(size=len(kept)), kept, period)[kept]
        every.append(e @ e / (kept.sum() - _common(kept, period)))
    assert np.mean(every) == pytest.approx(1.0, abs=4 * np.std(every) / np.sqrt(len(every)))


def test_few_rows_are_told_and_small_things_not_named(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, [1.0, 1.1], 1.1, 0.0, 0.3)
    (note,) = [one for one in found.notes if one.startswith("rows are too few for the base parameters")]
    assert " for 6 on joint 1: noise may hold part of the model" in note
    assert found.verdict == NOTHING
    assert not found.findings
