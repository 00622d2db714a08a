"""Gains by total least squares: how sure they are, where the model is right and where it is not."""

from __future__ import annotations

import numpy as np
import pytest

from identification.arrays import Array
from identification.total_least_squares import Part, solve

GAINS = np.array([0.5, 2.0, 4.0])
PARAMETERS = np.array([1.0, -2.0])


def parts(draw: np.random.Generator, noise: float, apart: float = 0.0) -> list[Part]:
    """Currents of three motors with the same parameters, but for a part by which they are ``apart``."""
    result = []
    for m, k in enumerate(GAINS):
        B, w = draw.normal(size=(300, 2)), draw.normal(size=300)
        effort = B @ (PARAMETERS * (1 + apart * (m - 1))) + w
        result.append(Part(m, B, w, effort / k + noise * draw.normal(size=300)))
    return result


def deviations(noise: float, apart: float) -> Array:
    return np.sqrt(np.diag(solve(parts(np.random.default_rng(0), noise, apart), 3).covariance))


def test_gains_lie_within_their_stated_uncertainty() -> None:
    away = []
    for seed in range(60):
        fit = solve(parts(np.random.default_rng(seed), 0.05), 3)
        away += ((fit.k - GAINS) / np.sqrt(np.diag(fit.covariance)[:3])).tolist()
    inside = np.abs(away) <= 2
    assert 0.9 <= inside.mean() <= 0.99


def test_what_the_motors_have_not_in_common_makes_gains_uncertain() -> None:
    """Each motor's currents alone agree with the model, and all together do not."""
    exact, some, twice = (deviations(1e-4, apart) for apart in (0.0, 0.02, 0.04))
    assert np.all(some[:3] > 10 * exact[:3])
    assert twice / some == pytest.approx(2.0, rel=0.05)
