"""Where something stays unexplained it is told whose positions come in coarse steps."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.diagnosis import UNEXPLAINED
from identification.diagnosis.verdict import trembling
from tests.diagnosis.diagnosed_arm import Array, diagnosis_of, recorded, rewritten


def bump(q: Array, qd: Array) -> Array:
    """In no law of the library."""
    return np.asarray(np.where(np.abs(q - 0.3) < 0.1, 8.0, 0.0))


@pytest.mark.parametrize("step", [pytest.param(0.0, marks=pytest.mark.long), 2e-4])
def test_coarse_steps_are_told_of_joints_that_keep_no_more_than_they_may_make(step: float, tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [bump] * 3)
    for source in sources:
        rewritten(source, lambda t, q, tau: (t, step * np.round(q / step) if step else q, tau))
    found = diagnosis_of(sources, regressors)
    assert found.verdict == UNEXPLAINED
    told = [note for note in found.notes if note.startswith("positions come in steps")]
    assert len(told) == bool(step)
    assert all("in steps, 0.0002 rad on joint 1, whose rounding" in note for note in told)
    (lack,) = found.search.bank.robot.numbers
    assert trembling.notes(found.search, {}) == []
    assert trembling.notes(found.search, {lack: 1e3}) == []
