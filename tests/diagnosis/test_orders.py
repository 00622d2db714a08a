"""Orders of a joint's turn at which a residual repeats, along long ways and short ones."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from identification.diagnosis.columns.orders import likely_orders

#: Samples of a run, and their distance [s].
_SAMPLES, _STEP = 6000, 0.005


def _scene(half: float, order: float, seed: int) -> Any:
    """A joint that swings by ``half`` [rad] to either side; its torque repeats with ``order`` beside what does not."""
    rng = np.random.default_rng(seed)
    t = _STEP * np.arange(_SAMPLES)
    rates = 2 * np.pi * np.array([0.1, 0.17, 0.31])
    phases = rng.uniform(0, 2 * np.pi, 3)[:, None]
    parts = np.sin(rates[:, None] * t + phases), rates[:, None] * np.cos(rates[:, None] * t + phases)
    q, qd = (half / 3 * part.sum(axis=0) for part in parts)
    slow = np.cumsum(rng.normal(size=_SAMPLES)) * 0.02
    tau = np.cos(order * q + 0.7) + slow + 0.3 * rng.normal(size=_SAMPLES)
    motion = SimpleNamespace(samples=_SAMPLES, q=q[None], qd=qd[None])
    return SimpleNamespace(motion=motion, tau=tau[None], model_torque=np.zeros((1, _SAMPLES)))


@pytest.mark.parametrize("half", [0.25, 0.5, 1.5, 3.0])
@pytest.mark.parametrize("order", [36, 40, 119])
def test_the_order_is_among_the_peaks(half: float, order: int) -> None:
    scenes = [_scene(half, order, seed) for seed in range(3)]
    near = np.pi / half / 3 if half < 1 else 0.5
    assert min(abs(one - order) for one in likely_orders(scenes, 0, 300)) <= near


def test_peaks_of_one_order_are_one() -> None:
    found = likely_orders([_scene(0.25, 40, seed) for seed in range(3)], 0, 300)
    assert min(np.diff(found)) > np.pi / 0.25 / 2 * 0.5


def test_a_joint_that_stands_repeats_nothing() -> None:
    scene = _scene(0.0, 40, 1)
    scene.motion.q[:] = 0.3
    assert likely_orders([scene], 0, 300) == ()


def test_a_wave_as_long_as_the_way_is_none() -> None:
    """It is no other than any torque that goes with the position."""
    assert min(likely_orders([_scene(0.4, 8, seed) for seed in range(3)], 0, 300)) > 2 * np.pi / 0.4 / 1.5
