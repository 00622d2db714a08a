"""Linear recursions against their own definition, sample by sample."""

from __future__ import annotations

import numpy as np
import pytest

from identification.recursion import from_start, recursion


@pytest.mark.parametrize("order", [1, 2, 3])
def test_each_value_is_made_of_those_before(order: int) -> None:
    draw = np.random.default_rng(order)
    factors, summands = draw.uniform(-0.7, 0.7, (order, 200)), draw.normal(size=200)
    expected = np.zeros(200)
    for i in range(200):
        expected[i] = summands[i] + sum(factors[k, i] * expected[i - 1 - k] for k in range(min(order, i)))
    np.testing.assert_allclose(recursion(list(factors), summands), expected, atol=1e-12 * np.abs(expected).max())


def test_what_grows_beyond_all_numbers_is_none() -> None:
    with np.errstate(all="ignore"):
        found = recursion([np.full(2000, 3.0)], np.ones(2000))
    assert np.isfinite(found[:600]).all()
    assert not np.isfinite(found[-1])


def test_a_recursion_begins_where_it_is_told() -> None:
    t = np.arange(51)
    np.testing.assert_allclose(from_start(np.full(50, 0.9), np.zeros(50), 3.0), 3.0 * 0.9**t)
    np.testing.assert_allclose(from_start(np.ones(50), np.full(50, 0.5), -2.0), -2.0 + 0.5 * t)
    np.testing.assert_array_equal(from_start(np.empty(0), np.empty(0), 4.0), [4.0])
