"""Rows near a reversal do not count, though no sample of a coarse log is slow."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.robot.readers import read
from identification.dataset import load
from identification.diagnosis.candidates import hypotheses
from identification.diagnosis.columns.hypothesis import EFFECT
from identification.diagnosis.runs.prepared import Prepared, prepared
from identification.diagnosis.runs.scene import Scene
from identification.observation import Regressors
from identification.recipes import Recipe
from identification.standstill import stands_throughout
from tests.diagnosis.diagnosed_arm import ARM, ready
from tests.recorded import Recorded, as_recorded, fourier, two_links


def moved(folder: Path, t: NDArray[np.float64], q: NDArray[np.float64]) -> Prepared:
    """A run along ``q`` [rad] at times ``t`` [s], as the diagnosis looks at it."""
    (folder / "arm.yaml").write_text(ARM)
    tau = np.sign(np.gradient(q)) + 0.1 * np.sin(3.7 * t)
    run = Recorded({"t": t, "q1": q, "tau1": tau}).save(folder / "a.csv")
    return ready(str(run), Regressors(read(folder / "arm.yaml")))


def test_a_joint_that_hardly_moves_stands() -> None:
    """One of two of a run, and one by itself."""
    way = np.array([0.0, 1.0, 0.5])
    moving, hardly = 2.1e-3 * way, 1.9e-3 * way
    assert stands_throughout(np.stack([moving, hardly])).tolist() == [False, True]
    assert stands_throughout(hardly)
    assert not stands_throughout(moving)


def test_a_reversal_passes_between_two_samples(tmp_path: Path) -> None:
    t = np.arange(1500) / 100.0
    run = moved(tmp_path, t, np.sin(0.9 * t) + 0.3 * np.sin(11.3 * t))
    speed = 0.9 * np.cos(0.9 * t) + 3.39 * np.cos(11.3 * t)
    turned = t[1:][np.diff(np.sign(speed)) != 0]
    kept = run.t[run.kept[0]]
    assert len(kept) > 100
    assert np.abs(kept[:, None] - turned).min() > 0.03


@pytest.mark.parametrize("rate", [50.0, 100.0, 125.0, 250.0])
@pytest.mark.parametrize("frequency", [1.0, 1.7, 2.2, 2.9, 3.6, 4.5, 5.2])
def test_a_joint_that_swings_keeps_rows(frequency: float, rate: float, tmp_path: Path) -> None:
    """Whatever its frequency: a reversal costs time before and after, and that of the row itself."""
    t = np.arange(round(20 * rate)) / rate
    run = moved(tmp_path, t, 0.4 * np.cos(2 * np.pi * frequency * t))
    assert np.mean(run.kept[0]) > 0.25


@pytest.mark.parametrize(("step", "moves"), [(0.0, False), (1e-5, False), (5e-4, False), (5e-3, True)])
def test_a_joint_that_stands_has_no_rows_and_no_candidates_of_its_own(step: float, moves: bool, tmp_path: Path) -> None:
    """Its encoder flickers by a step."""
    regressors, draw = two_links(tmp_path), np.random.default_rng(1)
    t, motion = fourier(regressors.model.robot, 10.0, 250.0, 1)
    q = np.stack([motion.q[0], 0.3 + step * (draw.random(len(t)) < 0.3)])
    path = as_recorded(regressors, t, q, draw.normal(size=q.shape)).save(tmp_path / "held.csv")
    run = prepared(load(str(path), regressors.model.robot), Recipe(), regressors)
    scene = Scene(run.sampled, regressors, dict.fromkeys(regressors.names, 1.0))
    assert [scene.moves(k) for k in (0, 1)] == [True, moves]
    assert run.kept[1].any() == moves
    assert any(one.kind == EFFECT and one.joints == (2,) for one in hypotheses([scene])) == moves
