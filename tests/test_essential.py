"""Essential parameters: where the elimination ends, with the limits that are told."""

from __future__ import annotations

import numpy as np
import pytest

from identification.essential import GROWTH, RATIO, essential
from identification.factors import factors
from identification.least_squares import Problem
from identification.sampling import Rows

NAMES = ("a", "b")


def orthogonal(b: float, noise: float, count: int = 400) -> Problem:
    """Rows of two orthogonal unit columns with parameters 1 and ``b``, residuals of norm ``noise`` beside both."""
    Q = np.linalg.qr(np.random.default_rng(0).normal(size=(count, 3)))[0]
    rows = Rows(0, NAMES, Q[:, :2], Q @ [1.0, b, noise], np.arange(float(count)))
    return Problem(factors([rows]), NAMES, {}, weighted=True)


@pytest.mark.parametrize(("growth", "kept"), [(0.035, NAMES[:1]), (0.045, NAMES)])
def test_a_parameter_stays_that_makes_the_residual_grow_by_more_than_four_percent(
    growth: float, kept: tuple[str, ...]
) -> None:
    """Without b the residual is sqrt(noise^2 + b^2), noise (1 + growth)."""
    noise = 1e-3
    problem = orthogonal(noise * np.sqrt((1 + growth) ** 2 - 1), noise)
    assert essential(problem, RATIO, GROWTH)[0].names == kept


@pytest.mark.parametrize(("deviations", "kept"), [(4.9, NAMES[:1]), (5.1, NAMES)])
def test_of_few_rows_a_parameter_stays_that_is_far_from_nothing(deviations: float, kept: tuple[str, ...]) -> None:
    """Of 90 rows the residual grows by 12 % without either."""
    noise = 1e-3
    assert essential(orthogonal(deviations * noise / np.sqrt(88), noise, 90), RATIO, GROWTH)[0].names == kept


@pytest.mark.parametrize(("ratio", "kept"), [(29.0, NAMES), (31.0, NAMES[:1])])
def test_elimination_ends_below_a_ratio_of_thirty(ratio: float, kept: tuple[str, ...]) -> None:
    """Columns of one length have one standard deviation: relative ones are as the inverse of the values."""
    assert essential(orthogonal(1 / ratio, 1e-3))[0].names == kept
