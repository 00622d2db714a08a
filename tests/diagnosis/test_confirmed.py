"""Of the model's torque, what noise of the positions makes is taken away where the recorded one does not have it."""

from __future__ import annotations

import numpy as np
import pytest

from identification.diagnosis.columns.confirmed import confirmed
from tests.recorded import Array

PERIOD, COUNT = 0.008, 2500


def signals(late: int = 0) -> tuple[Array, Array, Array]:
    """A torque, as the model tells it with noise of the accelerations, and as it is recorded ``late`` samples."""
    draw, t = np.random.default_rng(4), PERIOD * np.arange(-50, COUNT)
    true = sum(np.sin(2 * np.pi * f * t + f) for f in (0.3, 0.7, 1.9, 3.1))
    recorded = true[50 - late :][:COUNT] + 0.1 * draw.normal(size=COUNT)
    return true[50:], true[50:] + 0.3 * draw.normal(size=COUNT), recorded


def slope(x: Array, y: Array) -> float:
    return float(x @ y / (x @ x))


@pytest.mark.parametrize("late", [0, 6])
def test_changes_of_the_model_are_no_longer_too_large(late: int) -> None:
    """A coefficient of them is right on the average, however late the torque is recorded."""
    true, modelled, recorded = signals(late)
    (clean,) = confirmed(modelled[None], recorded[None], PERIOD, late * PERIOD)
    changes = [np.diff(x) for x in (true, modelled, clean)]
    assert slope(changes[1], changes[0]) < 0.1
    assert slope(changes[2], changes[0]) == pytest.approx(1.0, abs=0.1)
    assert np.corrcoef(changes[2], changes[0])[0, 1] > 0.95


def test_what_both_have_stays_and_so_do_few_samples() -> None:
    true, modelled, recorded = signals()
    (same,) = confirmed(true[None], true[None], PERIOD)
    assert same == pytest.approx(true, abs=1e-6)
    few = modelled[None, :15]
    assert confirmed(few, recorded[None, :15], PERIOD) is few
