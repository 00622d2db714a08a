"""Standard deviations from drawn stretches of time."""

from __future__ import annotations

from typing import cast

import numpy as np
import pytest

from identification.bootstrap import bootstrapped
from identification.factors import factors
from identification.least_squares import Problem
from identification.observed import Observed
from identification.sampling import Rows
from tests.told_rows import Told


@pytest.mark.parametrize("seconds", [0.8, 3.0, 40.0])
def test_runs_of_any_length_have_enough_blocks(seconds: float) -> None:
    """Where residuals are independent their standard deviations are those of least squares, however short the run."""
    draw, names, count = np.random.default_rng(0), ("a", "b"), round(seconds * 1000)
    ratios = []
    for _ in range(20):
        W = draw.normal(size=(count, 2))
        Y = W @ [1.0, 2.0] + draw.normal(size=count)
        run = Told((Rows(0, names, W, Y, np.arange(count) * 1e-3),), count)
        problem = Problem(factors(run.rows()), names, {}, weighted=True)
        solution = problem.solve()
        found = bootstrapped(problem, solution, [cast(Observed, run)], 200, rows=lambda one: one.rows())
        ratios.append([found.std(name) / solution.std(name) for name in names])
    # Of twenty blocks a standard deviation is known to a sixth, the mean of forty of them to 3 %.
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.08)
    assert np.std(ratios) < 0.25


def test_of_ordinary_least_squares_noise_of_any_joint_counts_as_it_is() -> None:
    """One joint a hundred times as noisy as the other: the covariance of least squares is
    W^+ diag(sigma_j^2) W^+^T, whatever the weights would make of it.
    """
    draw, names, count, noise = np.random.default_rng(1), ("a", "b", "c"), 4000, (100.0, 1.0)
    W = [draw.normal(size=(count, 3)) * share for share in ([0.1, 0.1, 1.0], [1.0, 1.0, 0.0])]
    t = np.arange(count) * 1e-3
    rows = [
        Rows(k, names, each, each @ [1.0, 2.0, 3.0] + sigma * draw.normal(size=count), t)
        for k, (each, sigma) in enumerate(zip(W, noise, strict=True))
    ]
    run = Told(tuple(rows), count)
    problem = Problem(factors(run.rows()), names, {}, weighted=False)
    found = bootstrapped(problem, problem.solve(), [cast(Observed, run)], 400, rows=lambda one: one.rows())
    spread = np.linalg.pinv(np.concatenate(W)) * np.repeat(noise, count)
    expected = np.linalg.norm(spread, axis=1)
    # Of twenty blocks a standard deviation is known to a sixth.
    assert [found.std(name) for name in names] == pytest.approx(expected, rel=0.5)
