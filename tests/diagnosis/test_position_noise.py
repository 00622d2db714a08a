"""White noise of recorded positions is told from the motion, and from the steps of its acceleration."""

from __future__ import annotations

import numpy as np
import pytest

from identification.diagnosis.runs.position_noise import deviations

RATE = 250.0


@pytest.mark.parametrize("deviation", [1e-7, 1e-5, 1e-3])
def test_noise_is_as_large_as_it_is(deviation: float) -> None:
    t = np.arange(5000) / RATE
    swinging = 0.8 * np.sin(2 * np.pi * t) + 0.05 * np.sin(2 * np.pi * 5 * t)
    # Point to point: an acceleration that jumps twice a second.
    jumping = np.cumsum(np.cumsum(np.sign(np.sin(2 * np.pi * t + 0.1)))) * 5 / RATE**2
    q = np.stack([swinging, jumping])
    noise = deviation * np.random.default_rng(1).normal(size=q.shape)
    assert deviations(q + noise) == pytest.approx([deviation, deviation], rel=0.1)


def test_a_smooth_motion_and_one_that_stands_have_none() -> None:
    t = np.arange(5000) / RATE
    assert deviations(np.stack([np.sin(2 * np.pi * t), np.full_like(t, 0.3)])) == pytest.approx([0.0, 0.0], abs=1e-13)
