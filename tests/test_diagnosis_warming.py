"""Friction that changes while a drive gets warm, in its own time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.diagnosis import NAMED
from tests.diagnosed_arm import diagnosis_of, recorded
from tests.recorded import Array

VISCOUS, DRY = -6.0, -3.0


@pytest.mark.parametrize("time", [12.0, 25.0, 80.0])
def test_the_time_of_warming_up_is_found(time: float, tmp_path: Path) -> None:
    def warming(q: Array, qd: Array) -> Array:
        warmth = 1 - np.exp(-0.01 * np.arange(len(q)) / time)
        return np.asarray(warmth * (VISCOUS * qd + DRY * np.sign(qd)))

    regressors, sources = recorded(tmp_path, [warming] * 3)
    found = diagnosis_of(sources, regressors)
    assert found.verdict == NAMED
    (one,) = found.findings
    assert one.hypothesis.effect == "warm_friction"
    assert one.shape["warm_up_time"] == pytest.approx(time, rel=0.5)
    for name, true in (("Fvw1", VISCOUS), ("Fcw1", DRY)):
        value = one.parameters[name]
        assert value.value == pytest.approx(true, abs=4 * value.std)
