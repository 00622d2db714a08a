"""Friction that changes while a drive gets warm, in its own time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.diagnosis import NAMED
from tests.diagnosis.diagnosed_arm import ARM, TRUTH, diagnosis_of, recorded
from tests.recorded import Array, parameters_text

VISCOUS, DRY = -6.0, -3.0


@pytest.mark.parametrize("time", [25.0, *(pytest.param(time, marks=pytest.mark.long) for time in (12.0, 80.0))])
def test_the_time_of_warming_up_is_found(time: float, tmp_path: Path) -> None:
    def warming(q: Array, qd: Array) -> Array:
        warmth = 1 - np.exp(-0.01 * np.arange(len(q)) / time)
        return np.asarray(warmth * (VISCOUS * qd + DRY * np.sign(qd)))

    regressors, sources = recorded(tmp_path, [warming] * 3)
    found = diagnosis_of(sources, regressors)
    assert found.verdict == NAMED
    (one,) = found.findings
    assert one.hypothesis.effect == "warm_friction"
    std = one.shape_std["warm_up_time"]
    assert std < 0.25 * time
    assert one.shape["warm_up_time"] == pytest.approx(time, abs=4 * std)
    for name, true in (("Fvw1", VISCOUS), ("Fcw1", DRY)):
        value = one.parameters[name]
        assert value.value == pytest.approx(true, abs=4 * value.std)


@pytest.mark.parametrize("cold", [pytest.param(0.0, marks=pytest.mark.long), 1.5])
def test_friction_that_is_known_of_a_warm_drive_is_more_all_along(cold: float, tmp_path: Path) -> None:
    """It changes from the file's values, or comes down from ``cold`` times as much beside them, of which most stays."""

    def warming(q: Array, qd: Array) -> Array:
        more = cold - (0.5 if cold else -0.5) * (1 - np.exp(-0.01 * np.arange(len(q)) / 20.0))
        return np.asarray(more * (TRUTH["Fv1"] * qd + TRUTH["Fc1"] * np.sign(qd)))

    regressors, sources = recorded(tmp_path, [warming] * 3, ARM + parameters_text({"known": TRUTH}))
    found = diagnosis_of(sources, regressors, "known")
    assert found.verdict == NAMED
    (one,) = found.findings
    assert one.hypothesis.effect == "warm_friction"
    std = one.shape_std["warm_up_time"]
    assert std < 4.0
    assert one.shape["warm_up_time"] == pytest.approx(20.0, abs=4 * std)
    for stem in ("Fv", "Fc"):
        change, start = one.parameters[f"{stem}w1"], one.parameters[f"{stem}w_start1"]
        part = -0.5 if cold else 0.5
        assert change.value == pytest.approx(part * TRUTH[f"{stem}1"], abs=4 * change.std)
        if cold:
            assert start.value == pytest.approx(cold * TRUTH[f"{stem}1"], abs=4 * start.std)
        else:
            assert not start.value
