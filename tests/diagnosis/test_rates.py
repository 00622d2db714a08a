"""Runs at several sampling rates: motion that starts and stops at once leaves no torque of its filters behind."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy import signal

from generator.robot.readers import read
from identification.diagnosis.diagnosis import NOTHING, diagnose
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.roles import Roles
from identification.observation import Motion, Regressors
from tests.diagnosis.diagnosed_arm import ARM, ready
from tests.recorded import Array, Recorded

TRUTH = {"ZZ1": 9.0, "MX1": 0.0, "MY1": 0.0, "Fv1": 14.0, "Fc1": 0.0, "Off1": 1.5}
#: Rate [Hz] at which the drive is played, and its two lags' time constant [s].
PLAYED, LAG = 2000, 0.01
#: Moves a run, the acceleration [rad/s2] of each, and the times [s] of its three parts and of the rest after it.
MOVES, ACCELERATION, PARTS = 12, 3.0, (0.4, 0.6, 0.4, 0.6)


def trapezoids(rate: float, seed: int) -> tuple[Array, Motion]:
    """There and back in trapezoids of speed, of sizes drawn at random, as a drive follows them that lags behind."""
    sizes = np.random.default_rng(seed).uniform(0.3, 1.0, MOVES) * np.where(np.arange(MOVES) % 2, -1, 1)
    wanted = [np.full(round(x * PLAYED), size * a) for size in sizes for a, x in zip((1, 0, -1, 0), PARTS, strict=True)]
    t = np.arange(sum(map(len, wanted))) / PLAYED
    chain = signal.StateSpace(
        [[-1 / LAG, 0, 0, 0], [1 / LAG, -1 / LAG, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]],
        [[ACCELERATION / LAG], [0], [0], [0]],
        np.eye(4)[[3, 2, 1]],
        np.zeros((3, 1)),
    )
    _, y, _ = signal.lsim(chain, np.concatenate(wanted), t, interp=False)
    every = round(PLAYED / rate)
    return t[::every], Motion(*y.T[:, None, ::every])


def played(folder: Path, rate: float, seed: int, noise: float) -> tuple[Regressors, Prepared]:
    (folder / "arm.yaml").write_text(ARM.replace("-9.81 m/s2", "0 m/s2"))
    regressors = Regressors(read(folder / "arm.yaml"))
    t, motion = trapezoids(rate, seed)
    tau = regressors.torques(TRUTH, motion)[0] + noise * np.random.default_rng(seed).normal(size=len(t))
    source = Recorded({"t": t, "q1": motion.q[0], "tau1": tau}).save(folder / f"{seed}.csv")
    return regressors, ready(str(source), regressors)


@pytest.mark.parametrize("rate", [100.0, 125.0, 250.0, 500.0, 1000.0])
def test_filters_leave_little_of_a_torque_that_jumps(rate: float, tmp_path: Path) -> None:
    regressors, run = played(tmp_path, rate, 1, 0.0)
    model = run.decimated(regressors.torques(TRUTH, run.sampled.motion))
    e, tau = ((x[0] - x[0].mean())[5:-5] for x in (run.tau - model, run.tau))
    assert np.sqrt(np.mean(e**2)) < 6e-4 * np.sqrt(np.mean(tau**2))


@pytest.mark.parametrize("rate", [125.0, 500.0])
def test_torques_that_jump_are_no_elasticity(rate: float, tmp_path: Path) -> None:
    runs = [played(tmp_path, rate, seed, 0.1) for seed in (1, 2)]
    names = tuple(str(tmp_path / f"{seed}.csv") for seed in (1, 2))
    found = diagnose(runs[0][0], [run for _, run in runs], Roles(names, (), (), names))
    assert found.verdict == NOTHING
