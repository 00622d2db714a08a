"""Positions that stay at an extreme: cut off, or turning there in the steps in which they are told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.robot.readers import read
from identification.dataset import load
from tests.recorded import SLIDE, Array, Recorded

T = np.arange(0, 8, 2e-4)


def swing(amplitude: float) -> Array:
    """About 0.5 m, every 2.5 s."""
    return np.asarray(0.5 + amplitude * np.sin(2 * np.pi * 0.4 * T))


def digits(x: Array, count: int) -> Array:
    """Numbers as a log writes them that has no more digits."""
    return np.array([float(f"{one:.{count}g}") for one in x])


def loaded(x: Array, folder: Path) -> int:
    (folder / "slide.yaml").write_text(SLIDE)
    tau = 3 * np.cos(2 * np.pi * 0.4 * T) + 0.1 * np.sin(40 * T)
    return load(
        str(Recorded({"t": T, "q1": x, "tau1": tau}).save(folder / "a.csv")), read(folder / "slide.yaml")
    ).samples


@pytest.mark.parametrize("amplitude", [0.52, 0.6, 0.73, 0.9])
@pytest.mark.parametrize("count", [5, 6])
def test_a_turn_told_in_few_digits_is_not_cut_off(amplitude: float, count: int, tmp_path: Path) -> None:
    assert loaded(digits(swing(amplitude), count), tmp_path) == len(T)


@pytest.mark.parametrize("limit", [1.05, 1.1, 1.2])
@pytest.mark.parametrize("count", [5, 6, 15])
def test_a_swing_that_lacks_its_end_is_cut_off_in_any_digits(limit: float, count: int, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"q1 stays at .*, expected a position that is not cut off"):
        loaded(digits(np.minimum(swing(0.9), limit), count), tmp_path)
