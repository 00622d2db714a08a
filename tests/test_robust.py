"""Huber's estimate: as certain as it says, with outliers and without, and nearly as good as least squares."""

from __future__ import annotations

from functools import cache
from typing import cast

import numpy as np
import pytest
from numpy.typing import NDArray

from identification.factors import factors
from identification.least_squares import Problem
from identification.observed import Observed
from identification.robust import robust
from identification.sampling import Rows
from tests.told_rows import Told

Array = NDArray[np.float64]

TRUTH = {"a": 1.0, "b": 2.0, "c": 3.0}
RUNS, ROWS = 800, 200


@cache
def estimates(share: float) -> tuple[Array, Array, Array]:
    """Of runs with a ``share`` of outliers ten times as large: errors over their stds, those of ordinary least squares
    over the same, and the part of rows that count less (RUNS x 3, RUNS x 3, RUNS).
    """
    found, plain, less = [], [], []
    for seed in range(RUNS):
        draw = np.random.default_rng(seed)
        W, Y = draw.normal(size=(ROWS, 3)), draw.normal(size=ROWS)
        Y[draw.uniform(size=ROWS) < share] *= 10
        run = Told((Rows(0, tuple(TRUTH), W, W @ [*TRUTH.values()] + Y, np.arange(float(ROWS))),))
        problem = Problem(factors(run.rows()), tuple(TRUTH), {}, weighted=True)
        result = robust(problem, [cast(Observed, run)])
        std = np.array([result.solution.std(name) for name in TRUTH])
        ordinary = problem.solve().values
        found.append([result.solution.values[name] - value for name, value in TRUTH.items()] / std)
        plain.append([ordinary[name] - value for name, value in TRUTH.items()] / std)
        less.append(result.outliers / ROWS)
    return np.array(found), np.array(plain), np.array(less)


@pytest.mark.parametrize("share", [0.0, 0.05])
def test_errors_are_as_large_as_they_are_told(share: float) -> None:
    """The rms of 2400 errors is known to 1.4 %, and off by less than three times that."""
    found, _, _ = estimates(share)
    assert np.sqrt(np.mean(found**2)) == pytest.approx(1.0, abs=3 / np.sqrt(2 * found.size))


def test_the_estimate_is_nearly_as_good_as_least_squares() -> None:
    """Its variance is 1/0.95 of theirs where the noise is Gaussian (Huber 1964), a third of it with outliers."""
    (found, plain, _), (struck, pulled, _) = estimates(0.0), estimates(0.05)
    assert np.mean(found**2) / np.mean(plain**2) == pytest.approx(1 / 0.95, abs=0.03)
    assert np.mean(struck**2) < 0.3 * np.mean(pulled**2)


def test_rows_count_less_from_the_knee_on() -> None:
    """Of Gaussian residuals 17.9 % are beyond 1.345 standard deviations."""
    _, _, less = estimates(0.0)
    assert float(less.mean()) == pytest.approx(0.179, abs=0.005)
