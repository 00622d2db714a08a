"""Friction that yields before it slides and falls as it slides: found with its whole Stribeck curve."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.diagnosis import NAMED
from identification.diagnosis.verdict.finding import FIRM
from tests.diagnosis.diagnosed_arm import Hidden, diagnosis_of, recorded
from tests.recorded import Array

#: Steps a sample of the recordings, at 100 Hz, in which the bristles bend.
_FINE, _RATE = 50, 100.0


def bristles(size: float, xs: float, excess: float, vs: float) -> Hidden:
    """The torque of LuGre's bristles without damping, each step solved exactly for a constant speed."""

    def of(q: Array, qd: Array) -> Array:
        z, result = 0.0, np.empty_like(qd)
        speeds = np.interp(np.arange(len(qd) * _FINE) / _FINE, np.arange(len(qd)), qd)
        for i, v in enumerate(speeds.tolist()):
            if i % _FINE == 0:
                result[i // _FINE] = size * z
            end = 1 + excess * math.exp(-((v / vs) ** 2))
            left = math.exp(-abs(v) / (xs * end * _RATE * _FINE))
            z = left * z + (1 - left) * math.copysign(end, v)
        return result

    return of


def test_the_whole_curve_is_found(tmp_path: Path) -> None:
    true = {"xs": 0.006, "excess": 0.9, "vs": 0.12}
    regressors, sources = recorded(tmp_path, [bristles(5.0, **true)] * 3)
    found = diagnosis_of(sources, regressors)
    (one,) = found.findings
    assert (found.verdict, one.hypothesis.effect, one.status) == (NAMED, "lugre_friction", FIRM)
    assert one.shape == pytest.approx(true, rel=0.15)
    assert one.parameters["Fz1"].value == pytest.approx(5.0, rel=0.1)
    for name, value in true.items():
        assert abs(one.shape[name] - value) < 4 * one.shape_std[name]
