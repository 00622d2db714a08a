"""Noise of recorded currents is not taken for an effect."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

from generator.robot.readers import read
from identification.diagnosis.candidates import current_limit
from identification.observation import Regressors
from tests.diagnosis.diagnosed import known, played
from tests.diagnosis.diagnosed_arm import diagnosis_of
from tests.plant.effect import Effect
from tests.plant.measurement import Sensors
from tests.plant.robots import ROBOTS
from tests.plant.trajectories.fourier import fourier
from tests.recorded import TRUTH, TWO_LINKS, as_recorded
from tests.recorded import fourier as fourier_of

LONG = fourier(1, period=10.0, periods=2, before=2.0)
#: Samples a second, and rms of the noise [N m] on joints whose torques are a few times as large.
RATE, NOISE = 100.0, 0.67


@pytest.mark.parametrize("clipped", [True, False])
def test_what_noise_exceeds_a_limit_by_is_not_missing(clipped: bool, tmp_path: Path) -> None:
    """A column of the recorded current shares its noise with the torque that it is to explain."""
    robot = known(ROBOTS["small_wrist"], tmp_path)
    effect = Effect("current_saturation", 1, 0.7) if clipped else Effect("offset", 1, 0.0)
    scene, _, _ = played(robot, effect, fourier(1, period=10.0, periods=1, before=2.0), Sensors(noise=0.05))
    offered = [one for one in current_limit.hypotheses([scene]) if one.joint == 1]
    limits = [robot.robot.chain[0].peak * 0.3] if clipped else [one.shapes[0].high for one in offered]
    found = [one.columns(scene, {"current_limit": limit}).any() for one in offered for limit in limits]
    assert any(found) == clipped


@pytest.mark.parametrize(
    ("memory", "seed"), [(0.045, 1), *(pytest.param(0.2, seed, marks=pytest.mark.long) for seed in (2, 6))]
)
def test_slow_noise_is_no_saturation(memory: float, seed: int, tmp_path: Path) -> None:
    """It changes as slowly as the torque does, and what of it exceeds a limit is missing in all runs."""
    (tmp_path / "two_links.yaml").write_text(TWO_LINKS)
    robot = read(tmp_path / "two_links.yaml")
    regressors, draw, sources = Regressors(robot), np.random.default_rng(seed), []
    for number in range(2):
        t, motion = fourier_of(robot, 40.0, RATE, 100 * seed + number)
        stays = np.exp(-1 / RATE / memory)
        noise = lfilter([NOISE * np.sqrt(1 - stays**2)], [1, -stays], draw.normal(size=(2, len(t) + 2000)))[:, 2000:]
        tau = regressors.torques(TRUTH, motion) + noise
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(tmp_path / f"{number}.csv")))
    found = diagnosis_of(sources, regressors)
    assert "current_limit" not in [one.hypothesis.effect for one in found.findings]


@pytest.mark.parametrize("samples", [1, 3])
def test_a_sample_gone_wrong_is_no_saturation(samples: int, tmp_path: Path) -> None:
    scene, _, _ = played(known(ROBOTS["small_wrist"], tmp_path), Effect("offset", 1, 0.0), LONG)
    (hypothesis,) = (one for one in current_limit.hypotheses([scene]) if one.joint == 1)
    limit = hypothesis.shapes[0].high
    wrong = scene.tau.copy()
    wrong[0, 5000 : 5000 + samples] += 20 * np.abs(wrong[0]).max()
    run = replace(scene, sampled=replace(scene.sampled, tau=wrong))
    assert not hypothesis.columns(run, {"current_limit": limit})[:, :, 4990:5010].any()
