"""Where no motion repeats, what follows from it by no law of the library is missing and is not noise."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NOTHING, UNEXPLAINED, Diagnosis
from tests.diagnosis.diagnosed_arm import Hidden, answered, recorded
from tests.recorded import Array

#: Frequency [Hz] of the slowest sine: runs of 40 s never repeat.
SLOWEST = 0.017
#: Of the noise [N m].
NOISE = 0.6


def bump(q: Array, qd: Array) -> Array:
    """Whichever way the link moves."""
    return np.asarray(4.0 * np.exp(-(((q - 0.3) / 0.1) ** 2)))


def spot(q: Array, qd: Array) -> Array:
    """Against the motion."""
    return np.asarray(4.0 * np.sign(qd) * (np.abs(q - 0.3) < 0.15))


def nothing(q: Array, qd: Array) -> Array:
    return np.zeros_like(q)


def load(q: Array, qd: Array) -> Array:
    return np.asarray(8.0 * np.cos(q))


def diagnosis(folder: Path, hidden: Sequence[Hidden]) -> Diagnosis:
    """Of as many runs, the last of which tests."""
    _, sources = recorded(folder, hidden, noise=NOISE, stays=0.5, draws=7, slowest=SLOWEST)
    return answered(folder / "arm.yaml", Request(sources), folder / "out")[0]


@pytest.mark.parametrize("hidden", [bump, pytest.param(spot, marks=pytest.mark.long)])
def test_what_acts_at_a_place_alone_stays_unexplained(hidden: Hidden, tmp_path: Path) -> None:
    found = diagnosis(tmp_path, [hidden] * 4)
    assert found.verdict == UNEXPLAINED
    assert found.after.joint == 1
    assert not any(one.status == "firm" for one in found.findings)


def test_noise_is_noise_all_the_same(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, [nothing] * 4)
    assert (found.verdict, found.findings) == (NOTHING, ())


@pytest.mark.long
def test_a_load_in_one_run_is_not_noise(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, [nothing, load, nothing, nothing])
    assert found.verdict == UNEXPLAINED
    assert any("without 2.csv the other runs agree" in note for note in found.notes)
