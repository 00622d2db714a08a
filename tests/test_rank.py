"""Parameters that rows do not show by themselves, however small their share in a dependency."""

from __future__ import annotations

import numpy as np
import pytest

from identification.factors import factors
from identification.least_squares import Problem
from identification.rank import nonzero, not_identifiable
from identification.sampling import Rows
from identification.total_least_squares import Part, solve


def test_directions_and_singular_values() -> None:
    unseen = np.array([[0.8, 2e-4, 0.6, 0.0], [0.0, 0.0, 5e-5, 1.0]])
    assert not_identifiable(unseen).tolist() == [True, True, True, True]
    assert not_identifiable(unseen[1:]).tolist() == [False, False, False, True]
    assert not_identifiable(unseen[:0]).tolist() == [False] * 4
    assert nonzero(np.array([5.0, 5e-7, 4e-8])).tolist() == [True, True, False]
    assert nonzero(np.array([1e-3, 1.0]), 1e-2).tolist() == [False, True]


#: Share of the second parameter in the third, whose column is the first's beside it; and whether that hides the second.
SHARES = [(0.3, True), (1e-2, True), (1e-3, True), (1e-5, False)]


@pytest.mark.parametrize(("share", "hides"), SHARES)
def test_a_small_share_in_a_dependency_hides_a_parameter(share: float, hides: bool) -> None:
    draw = np.random.default_rng(0)
    W = draw.normal(size=(400, 4))
    W[:, 2] = W[:, 0] + share * W[:, 1]
    rows = Rows(0, ("a", "b", "c", "d"), W, W @ [1.0, 2.0, 3.0, 4.0] + 0.1 * draw.normal(size=400), np.arange(400.0))
    solution = Problem(factors([rows]), rows.names, {}, weighted=True).solve()
    assert set(solution.hidden) == {"a", "c"} | ({"b"} if hides else set())
    assert solution.rank == 3


@pytest.mark.parametrize(("share", "hides"), SHARES)
def test_so_it_does_beside_gains(share: float, hides: bool) -> None:
    draw = np.random.default_rng(0)
    B, w = draw.normal(size=(400, 4)), draw.normal(size=400)
    B[:, 2] = B[:, 0] + share * B[:, 1]
    i = (B @ [1.0, 2.0, 3.0, 4.0] + w) / 0.5 + 0.1 * draw.normal(size=400)
    fit = solve([Part(0, B, w, i)], 1)
    assert fit.hidden.tolist() == [True, hides, True, False]
    assert np.isinf(np.diag(fit.covariance)[1:]).tolist() == [True, hides, True, False]
