"""Efforts that were recorded in coarse steps: rounding is noise, in what periods have in common too."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from generator.robot.readers import read
from identification.diagnosis.diagnosis import NAMED, NOTHING
from identification.diagnosis.noise import noise_floor
from identification.diagnosis.noise.effort_rounding import _between, effort_rounding, notes, told
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.scene import Scene
from identification.observation import Motion, Regressors
from tests.diagnosis.diagnosed_arm import ARM, TRUTH, diagnosis_of, ready, recorded, rewritten, torque
from tests.elastic_links import KT, N
from tests.recorded import TRUTH as TWO
from tests.recorded import Array, Recorded, fourier, stacked, two_links
from tests.recorded import recorded as recorded_links

STEP = 5.0
#: Step of the currents [A] of two motors.
CURRENT = 0.02


def coarse(sources: list[str], step: float) -> None:
    """Rounds the torques of recorded runs."""
    for source in sources:
        rewritten(source, lambda t, q, tau: (t, q, step * np.round(tau / step)))


def of_periods(run: Prepared, x: Array) -> Array:
    """Whole periods of a joint's rows, one a row."""
    count = len(run.t) // run.period
    return np.asarray(x[0, : count * run.period].reshape(count, run.period))


@pytest.mark.parametrize("noise", [0.0, 0.1, 0.15])
def test_what_periods_have_in_common_is_as_large_as_it_says(noise: float, tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(ARM)
    regressors, draw = Regressors(read(tmp_path / "arm.yaml")), np.random.default_rng(2)
    t, motion = fourier(regressors.model.robot, 198.0, 100.0, 1)
    exact = regressors.torques(TRUTH, motion)[0] + noise * STEP * draw.normal(size=len(t))
    saved = Recorded({"t": t, "q1": motion.q[0], "tau1": STEP * np.round(exact / STEP)}).save(tmp_path / "a.csv")
    run = ready(str(saved), regressors)
    first = run.sampled.filters.first
    error = run.decimated((run.sampled.run.tau - exact)[:, first : first + run.sampled.motion.samples])
    periods = of_periods(run, error)
    common = np.mean(periods.mean(axis=0) ** 2) - np.mean(periods.var(axis=0, ddof=1)) / len(periods)
    said = effort_rounding(run, Scene(run.sampled, regressors, TRUTH))
    assert np.mean(said**2) / (len(run.t) / run.period) == pytest.approx(common, rel=0.25)


def with_ways(motion: Motion, before: int, after: int) -> Motion:
    """A motion at 100 Hz with ways to where it begins and from where it ends, of so many samples."""
    q, v = motion.q[0], motion.qd[0]
    to = CubicHermiteSpline([0, before / 100], [q[0] - 1.2, q[0]], [0, v[0]])
    back = CubicHermiteSpline([0, after / 100], [q[-1], q[-1] + 1.0], [v[-1], 0])
    ways = np.arange(before) / 100, np.arange(1, after + 1) / 100
    parts = [(to(ways[0], n), x[0], back(ways[1], n)) for n, x in enumerate((motion.q, motion.qd, motion.qdd))]
    return Motion(*(np.concatenate(part)[None] for part in parts))


@pytest.mark.parametrize(("seconds", "way"), [(60.0, 300), (19.9, 0)])
def test_neither_ways_nor_a_period_that_is_cut_hide_steps(seconds: float, way: int, tmp_path: Path) -> None:
    """Of periods of ten seconds; what steps leave in the mean is that of many draws of noise."""
    (tmp_path / "arm.yaml").write_text(ARM)
    regressors, draw = Regressors(read(tmp_path / "arm.yaml")), np.random.default_rng(2)
    _, motion = fourier(regressors.model.robot, seconds, 100.0, 1)
    motion = with_ways(motion, way, way) if way else motion
    exact = regressors.torques(TRUTH, motion)[0]
    draws = STEP * np.round(exact / STEP + 0.1 * draw.normal(size=(300, motion.samples)))
    columns = {"t": np.arange(motion.samples) / 100, "q1": motion.q[0], "tau1": draws[0]}
    run = ready(str(Recorded(columns).save(tmp_path / "a.csv")), regressors)
    first, kept = run.sampled.filters.first, run.kept[0]
    error = run.decimated((draws.mean(axis=0) - exact)[first : first + run.sampled.motion.samples])
    said = effort_rounding(run, Scene(run.sampled, regressors, TRUTH))[0] / np.sqrt(run.times)
    assert np.std(said[kept]) == pytest.approx(np.std(error[kept]), rel=0.1)


@pytest.mark.parametrize(("period", "known"), [(5, True), (1, False)])
def test_short_periods_are_compared_as_far_as_they_can_be(period: int, known: bool) -> None:
    variance = _between(np.random.default_rng(1).normal(size=500), period)
    assert variance == pytest.approx(1.0, abs=0.3) if known else np.isinf(variance)


def test_fine_torques_take_no_steps(tmp_path: Path) -> None:
    regressors, (source,) = recorded(tmp_path, [torque("")])
    run = ready(source, regressors)
    assert run.sampled.run.coarse is None
    assert not effort_rounding(run, Scene(run.sampled, regressors, TRUTH)).any()


def test_coarse_torques_lack_nothing_and_are_told(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque("")] * 3)
    assert notes(diagnosis_of(sources, regressors).search.bank) == []
    coarse(sources, STEP)
    found = diagnosis_of(sources, regressors)
    assert found.verdict == NOTHING
    assert notes(found.search.bank) == ["torques take steps, 5 N m on joint 1: what rounding leaves counts as noise"]
    assert noise_floor.notes(found.search.bank, told(found.search.bank)) == []


def test_lost_samples_and_a_beginning_of_its_own_hide_no_steps(tmp_path: Path) -> None:
    def lossy(t: Array, q: Array, tau: Array) -> tuple[Array, Array, Array]:
        tau = STEP * np.round((tau + 60.0 * np.exp(-t / 0.3)) / STEP)
        there = np.arange(len(t)) % 700 != 350
        return t[there], q[there], tau[there]

    regressors, sources = recorded(tmp_path, [torque("")] * 3)
    for source in sources:
        rewritten(source, lossy)
    found = diagnosis_of(sources, regressors)
    assert found.verdict == NOTHING
    assert told(found.search.bank) == pytest.approx({0: STEP}, rel=1e-6)


def test_fine_steps_are_not_told(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque("")] * 2)
    coarse(sources, 0.3)
    assert told(diagnosis_of(sources, regressors).search.bank) == {}


def test_what_is_larger_than_the_steps_is_found(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque("stribeck")] * 3)
    coarse(sources, STEP)
    found = diagnosis_of(sources, regressors)
    assert found.verdict == NAMED
    assert [one.hypothesis.effect for one in found.findings] == ["stribeck_friction"]


def test_steps_of_coupled_motors_act_on_the_joints_that_they_drive(tmp_path: Path) -> None:
    regressors = two_links(tmp_path)
    good = recorded_links(regressors, TWO, duration=40.0)
    exact = np.linalg.solve(N.T, stacked(good, "tau")) / KT[:, None]
    currents = CURRENT * np.round(exact / CURRENT)
    saved = good.without("tau1", "tau2").with_columns(i1=currents[0], i2=currents[1]).save(tmp_path / "a.csv")
    run = ready(str(saved), regressors)
    found = run.sampled.run.coarse
    assert found is not None
    assert found.acting == pytest.approx(N.T * KT)
    assert found.steps == pytest.approx([CURRENT] * 2, rel=1e-6)
    assert found.of_joints == pytest.approx([100.0 * KT[0] * CURRENT, 80.0 * KT[1] * CURRENT])
    first = run.sampled.filters.first
    error = (N.T * KT) @ (currents - exact)
    error = run.decimated(error[:, first : first + run.sampled.motion.samples])
    said = effort_rounding(run, Scene(run.sampled, regressors, TWO)) / np.sqrt(run.times)
    assert said.std(axis=-1) == pytest.approx(error.std(axis=-1), rel=0.25)
