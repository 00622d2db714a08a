"""Chance, as the test of what a residual holds counts it."""

from __future__ import annotations

import numpy as np
import pytest

from identification.diagnosis.verdict.f_test import f_test


@pytest.mark.parametrize(("count", "fitted"), [(24, 8), (40, 10), (400, 30)])
def test_noise_passes_as_often_as_it_says_though_values_were_fitted(count: int, fitted: int) -> None:
    """White noise beside what a fit took of it: p is even between 0 and 1."""
    draw, p = np.random.default_rng(3), []
    for _ in range(3000):
        model = np.linalg.qr(draw.normal(size=(count, fitted)))[0].T
        e, X = draw.normal(size=count), draw.normal(size=(2, count))
        e, X = e - (model @ e) @ model, X - (X @ model.T) @ model
        p.append(f_test(X, e, fitted).p)
    for level in (0.01, 0.1, 0.5):
        deviation = np.sqrt(level * (1 - level) / len(p))
        assert np.mean(np.array(p) < level) == pytest.approx(level, abs=3.5 * deviation)


def test_of_few_values_nothing_is_told() -> None:
    X = np.random.default_rng(4).normal(size=(3, 30))
    assert f_test(X, X.sum(axis=0), 5).p < 1e-6
    few = f_test(X, X.sum(axis=0), 20)
    assert (few.rank, few.p) == (3, 1.0)
    assert f_test(np.zeros((2, 30)), X[0], 0).rank == 0
