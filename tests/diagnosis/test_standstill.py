"""Rows near a reversal do not count, though no sample of a coarse log is slow."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from generator.robot.readers import read
from identification.observation import Regressors
from tests.diagnosis.diagnosed_arm import ARM, ready
from tests.recorded import Recorded


def test_a_reversal_passes_between_two_samples(tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(ARM)
    regressors = Regressors(read(tmp_path / "arm.yaml"))
    t = np.arange(1500) / 100.0
    q = np.sin(0.9 * t) + 0.3 * np.sin(11.3 * t)
    tau = np.sign(np.gradient(q)) + 0.1 * np.sin(3.7 * t)
    run = ready(str(Recorded({"t": t, "q1": q, "tau1": tau}).save(tmp_path / "a.csv")), regressors)
    speed = 0.9 * np.cos(0.9 * t) + 3.39 * np.cos(11.3 * t)
    turned = t[1:][np.diff(np.sign(speed)) != 0]
    kept = run.t[run.kept[0]]
    assert len(kept) > 100
    assert np.abs(kept[:, None] - turned).min() > 0.03
