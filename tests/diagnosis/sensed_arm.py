"""Runs of the arm whose positions a sensor tells."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from generator.robot.readers import read
from identification.observation import Regressors
from tests.diagnosis.diagnosed_arm import ARM, TRUTH
from tests.recorded import Array, Recorded, fourier

#: One of 4096 steps of a motor behind a gear of 60.
STEP, FINE = 2 * np.pi / 4096 / 60, 1e-13
RATE = 500.0


def sensed(
    folder: Path, count: int, noise: float, sensor: Callable[[Array], Array], slowest: float = 0.2
) -> tuple[Regressors, list[str]]:
    """Runs of the arm with the torques of its true motion, and positions as a sensor tells them."""
    path = folder / "arm.yaml"
    path.write_text(ARM)
    robot = read(path)
    regressors, draw, sources = Regressors(robot), np.random.default_rng(5), []
    for seed in range(1, count + 1):
        t, motion = fourier(robot, 20.0, RATE, seed, slowest)
        tau = regressors.torques(TRUTH, motion)[0] + noise * draw.normal(size=len(t))
        sources.append(str(Recorded({"t": t, "q1": sensor(motion.q[0]), "tau1": tau}).save(folder / f"{seed}.csv")))
    return regressors, sources


def rounded(step: float) -> Callable[[Array], Array]:
    """A sensor in steps."""
    return lambda q: step * np.round(q / step)


def noisy(deviation: float) -> Callable[[Array], Array]:
    """A sensor with white noise."""
    draw = np.random.default_rng(8)
    return lambda q: q + deviation * draw.normal(size=q.shape)
