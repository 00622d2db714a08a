"""A drive train's swing is heard in the recorded torque; what noise of the positions makes of inertia is not."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.signal import butter, sosfilt

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import EFFECT, ELASTIC, Coefficient
from identification.diagnosis.search.swings_heard import heard
from tests.matrices import variant

ROWS = 1500


def swing(kind: str) -> Variant:
    return variant("joint_elasticity", Coefficient("compliance1", "rad/(N m)"), 1, kind=kind)


def bank(swings: bool, repeats: bool, rows: int, size: float) -> Any:
    """One run of a joint, whose recorded torque swings or is noise."""
    draw = np.random.default_rng(2)
    column, noise = size * draw.normal(size=(1, rows)), draw.normal(size=rows)
    run = SimpleNamespace(tau=[0.2 * column[0] * swings + noise])
    return SimpleNamespace(
        robot=SimpleNamespace(numbers=(1,)),
        runs=[run],
        alone=() if repeats else (0,),
        columns=lambda r, k, numbers: column,
        whitened=lambda r, k, rows: rows,
    )


@pytest.mark.parametrize(
    ("swings", "repeats", "kind", "rows", "size", "told"),
    [
        (False, False, ELASTIC, ROWS, 3.0, False),
        (True, False, ELASTIC, ROWS, 3.0, True),
        (False, True, ELASTIC, ROWS, 3.0, True),
        (False, False, EFFECT, ROWS, 3.0, True),
        (False, False, ELASTIC, ROWS, 1.0, True),
        (False, False, ELASTIC, 300, 3.0, False),
        (True, False, ELASTIC, 300, 3.0, True),
        (False, False, ELASTIC, 100, 3.0, True),
    ],
)
def test_a_loud_swing_is_in_the_recorded_torque_too(
    swings: bool, repeats: bool, kind: str, rows: int, size: float, told: bool
) -> None:
    """What few rows do not tell, and what the noise of runs that repeat tells, is not asked."""
    assert heard(bank(swings, repeats, rows, size), [0], swing(kind), np.ones(1)) == told


def test_noise_of_a_narrow_band_is_not_heard_by_chance() -> None:
    """A swing is of few frequencies, whose spectra are few independent numbers."""
    band, heard_ = butter(4, (0.25, 0.35), "bandpass", output="sos"), 0
    for seed in range(40):
        one = bank(False, False, ROWS, 3.0)
        column = sosfilt(band, np.random.default_rng(100 + seed).normal(size=ROWS))[None]
        one.columns = lambda r, k, numbers, column=column: 3.0 * column / column.std()
        heard_ += heard(one, [0], swing(ELASTIC), np.ones(1))
    assert heard_ <= 1
