"""Runs that do not agree are told by name."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.diagnosis import UNEXPLAINED
from tests.diagnosis.diagnosed_arm import Hidden, diagnosis_of, recorded, torque
from tests.recorded import Array


def loaded(q: Array, qd: Array) -> Array:
    """A weight of 8 N on an arm of a metre."""
    return 8.0 * np.cos(q)


def bumps(q: Array, qd: Array) -> Array:
    """What no run can be fitted with."""
    return np.asarray(5.0 * (np.exp(-(((q - 0.5) / 0.05) ** 2)) - np.exp(-(((q + 0.3) / 0.05) ** 2))))


@pytest.mark.parametrize(
    ("hidden", "told"),
    [
        ([torque(""), loaded, torque("")], "without 2.csv the other runs agree: look for another load"),
        ([torque(""), loaded], "1.csv and 2.csv do not agree, each alone is explained: look for another load"),
        ([bumps] * 3, None),
        ([bumps] * 2, None),
    ],
)
def test_the_run_that_differs_from_the_others_is_told(hidden: list[Hidden], told: str | None, tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, hidden)
    found = diagnosis_of(sources, regressors)
    assert found.verdict == UNEXPLAINED
    notes = [note for note in found.notes if "agree" in note]
    assert len(notes) == (told is not None)
    assert all((told or "") in note for note in notes)
