"""Samples that stand out alone are interpolated and told; jumps, peaks and steps are the signal's own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.errors import InputError
from generator.robot.readers import read
from identification.dataset import load
from identification.glitches import glitches
from identification.observation import Regressors
from tests.recorded import TRUTH, TWO_LINKS, Recorded, fourier

Array = NDArray[np.float64]

T = np.arange(8000) / 500
#: A motion's torque, with friction that jumps where it reverses.
SMOOTH = 20 * np.sin(2 * np.pi * 0.3 * T) + 6 * np.sign(np.cos(2 * np.pi * 0.3 * T + 0.2))


def noisy(x: Array, deviation: float) -> Array:
    return x + deviation * np.random.default_rng(4).normal(size=x.shape)


@pytest.mark.parametrize("noise", [0.0, 0.05, 0.3])
@pytest.mark.parametrize("wrong", [[100], [100, 101], [100, 101, 102], [40, 300, 301, 5000]])
def test_glitches_are_found(wrong: list[int], noise: float) -> None:
    x = noisy(SMOOTH, noise)
    x[wrong] += 15.0
    assert glitches(x).tolist() == wrong


def test_a_dropout_to_zero_is_found() -> None:
    x = noisy(SMOOTH, 0.1)
    x[[90, 91]] = 0.0
    assert glitches(x).tolist() == [90, 91]


@pytest.mark.parametrize(
    "x",
    [
        SMOOTH,
        noisy(SMOOTH, 0.2),
        np.round(noisy(SMOOTH, 0.2)),
        np.abs((0.9 * T) % 2 - 1),
        np.repeat(noisy(SMOOTH, 0.2)[::5], 5),
        np.random.default_rng(1).standard_t(4, size=8000),
        np.zeros(8000),
        np.arange(6.0),
    ],
    ids=["jumps", "noise", "coarse", "kinks", "held", "heavy tails", "nothing", "short"],
)
def test_what_is_the_signals_own_stays(x: Array) -> None:
    assert not glitches(x).size


def test_many_are_no_glitches() -> None:
    x = noisy(SMOOTH, 0.1)
    x[::50] += 10.0
    assert not glitches(x).size


def test_a_run_is_read_without_them_and_says_so(tmp_path: Path) -> None:
    path = tmp_path / "two_links.yaml"
    path.write_text(TWO_LINKS)
    robot = read(path)
    t, motion = fourier(robot, 10.0, 500.0)
    tau = Regressors(robot).torques(TRUTH, motion)
    columns = {f"q{k}": x for k, x in enumerate(motion.q, 1)} | {f"tau{k}": x for k, x in enumerate(tau, 1)}
    good = load(str(Recorded({"t": t, **columns}).save(tmp_path / "good.csv")), robot)
    spoilt = {name: x.copy() for name, x in columns.items()}
    spoilt["q1"][700] += 0.02
    spoilt["tau2"][[1200, 1201, 3000]] = -500.0
    run = load(str(Recorded({"t": t, **spoilt}).save(tmp_path / "spoilt.csv")), robot)
    np.testing.assert_allclose(run.q, good.q, atol=1e-9)
    np.testing.assert_allclose(run.tau, good.tau, atol=1e-2)
    first, second = run.notes
    assert "spoilt.csv:702:" in first
    assert first.endswith("q1 is off from its neighbours; it was interpolated")
    assert "spoilt.csv:1202:" in second
    assert "tau2 is off from its neighbours, and 2 further samples too" in second


def test_a_position_far_from_all_others_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "two_links.yaml"
    path.write_text(TWO_LINKS)
    robot = read(path)
    t, motion = fourier(robot, 10.0, 500.0)
    q = motion.q.copy()
    q[0, 700] += 1.5
    columns = {f"q{k}": x for k, x in enumerate(q, 1)} | {f"tau{k}": x for k, x in enumerate(motion.qd, 1)}
    with pytest.raises(InputError, match="q1 jumps"):
        load(str(Recorded({"t": t, **columns}).save(tmp_path / "far.csv")), robot)
